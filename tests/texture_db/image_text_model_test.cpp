#include "texture_db/describe/image_text_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/texture_db/scratch.h"
#include "tests/texture_db/tiny_onnx.h"

namespace weft {
namespace {

using testing::HasSubstr;

constexpr const char* kWords =
    R"({"crimson": [1, -1, -1], "zorblax": [1, -1, -1], "lawn": [-1, 1, -1],
                                   "grass": [-1, 1, -1], "stone": [1, -1, -1]})";
constexpr const char* kModel = R"({"name": "tiny", "image": "image.onnx", "words": "words.json",
    "size": 16, "mean": [0.5, 0.5, 0.5], "deviation": [0.25, 0.25, 0.25], "scale": 10})";

std::string model_in(const std::string& folder, const std::string& json = kModel,
                     const std::string& words = kWords) {
    std::filesystem::create_directories(folder);
    write_file(folder + "/model.json", json);
    write_file(folder + "/image.onnx", mean_colour_onnx(16));
    write_file(folder + "/words.json", words);
    return folder;
}

ImageU8x3 plain(std::uint8_t r, std::uint8_t g, std::uint8_t b) {
    ImageU8x3 image(96, 96);
    for (int y = 0; y < 96; ++y) {
        for (int x = 0; x < 96; ++x) {
            const std::uint8_t grain = (x * 7 + y * 13) % 5;
            image.at(x, y, 0) = r + grain;
            image.at(x, y, 1) = g + grain;
            image.at(x, y, 2) = b + grain;
        }
    }
    return image;
}

TEST(ImageTextModel, PutsPicturesAndWordsIntoOneSpace) {
    const Scratch scratch;
    auto model = ImageTextModel::open(model_in(scratch.at("tiny")));
    ASSERT_TRUE(model) << model.error().text();
    EXPECT_EQ(model->name(), "tiny");
    EXPECT_EQ(model->dimensions(), 3);
    const auto red = model->encode_image(plain(220, 20, 20));
    ASSERT_TRUE(red) << red.error().text();
    EXPECT_GT((*red)[0], 0);
    EXPECT_LT((*red)[1], 0);
    EXPECT_NEAR((*red)[0] * (*red)[0] + (*red)[1] * (*red)[1] + (*red)[2] * (*red)[2], 1, 1e-5);
    EXPECT_TRUE(model->encode_text("velvet").empty());
    EXPECT_EQ(model->encode_text("Crimsons velvet"), model->encode_text("crimson"));
    const std::vector<float> likely = model->likelihoods(*red, {"grass", "stone", "velvet"});
    EXPECT_NEAR(likely[0] + likely[1], 1, 1e-5);
    EXPECT_GT(likely[1], 0.95f);
    EXPECT_EQ(likely[2], 0) << "a word that the model does not know";
}

TEST(ImageTextModel, SaysWhatIsWrongWithItsFolder) {
    const Scratch scratch;
    const auto fault = [&](const char* name, const std::string& json, const std::string& words) {
        const auto model = ImageTextModel::open(model_in(scratch.at(name), json, words));
        return model ? std::string("none") : model.error().text();
    };
    const auto missing = ImageTextModel::open(scratch.at("nowhere"));
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().code, ErrorCode::kUnreadable);
    EXPECT_THAT(missing.error().text(), HasSubstr("model.json is missing"));
    EXPECT_THAT(fault("json", "{", kWords), HasSubstr("model.json is not JSON"));
    EXPECT_THAT(fault("out", R"({"image": "../image.onnx", "words": "words.json"})", kWords),
                HasSubstr("out of its range"));
    EXPECT_THAT(fault("length", kModel, R"({"a": [1, 0], "b": [0, 1]})"),
                HasSubstr("has 2 numbers, the network gives 3"));
    EXPECT_THAT(fault("few", kModel, R"({"a": [1, 0, 0]})"), HasSubstr("fewer than two words"));
    const std::string damaged = model_in(scratch.at("damaged"));
    write_file(damaged + "/image.onnx", mean_colour_onnx(16).substr(0, 40));
    EXPECT_FALSE(ImageTextModel::open(damaged));
}

TEST(ImageTextModel, IsAskedBySearchesOfALibraryThatNamesIt) {
    const Scratch scratch;
    const auto library = open_or_die(scratch.at("a.db"));
    ASSERT_TRUE(library);
    std::vector<NewTexture> textures;
    for (int i = 0; i < 20; ++i) {
        NewTexture t = new_texture(i, "wood", "sample");
        const auto shade = static_cast<std::uint8_t>(60 + 5 * i);
        t.pixels = i == 0 ? plain(230, 20, 20) : plain(shade, shade, 100);
        textures.push_back(t);
    }
    ASSERT_EQ(library->add(textures), 20);
    SearchQuery query;
    const std::string model = model_in(scratch.at("tiny"));
    int looked_at = 0;
    ASSERT_TRUE(library->use_image_text_model(
        model, {}, [&](const ProgressEvent& e) { looked_at = static_cast<int>(e.done); }));
    EXPECT_EQ(looked_at, 20);
    EXPECT_EQ(library->image_text_model(), model);
    query.text = "crimson";
    const auto found = library->search(query);
    ASSERT_TRUE(found) << found.error().text();
    ASSERT_FALSE(found->hits.empty());
    const auto red = library->thumbnail(found->hits[0].id);
    ASSERT_TRUE(red);
    EXPECT_GT(red->at(0, 0, 0), 200);
    EXPECT_THAT(found->hits[0].reasons, testing::Contains("matches according to tiny"));

    query.text = "zorblax";  // a word of the model alone
    const auto by_image = library->search(query);
    ASSERT_TRUE(by_image);
    ASSERT_EQ(by_image->total, 1);
    EXPECT_EQ(by_image->hits[0].id, found->hits[0].id);

    // Another connection names another one: the first goes over to it.
    const std::string other = model_in(scratch.at("other"), R"({"name": "other",
        "image": "image.onnx", "words": "words.json", "size": 16})");
    ASSERT_TRUE(open_or_die(scratch.at("a.db"))->use_image_text_model(other));
    const auto went_over = library->search(query);
    ASSERT_TRUE(went_over);
    EXPECT_THAT(went_over->understood, testing::Not(testing::Contains(HasSubstr("changed"))));
    ASSERT_TRUE(library->use_image_text_model(model));

    looked_at = 0;
    ASSERT_TRUE(library->use_image_text_model(
        model, {}, [&](const ProgressEvent& e) { looked_at = static_cast<int>(e.done); }));
    EXPECT_EQ(looked_at, 0) << "what is known is not looked at again";

    // Gone from the disk: the search goes on without it, and says so.
    std::filesystem::remove_all(model);
    const auto reopened = open_or_die(scratch.at("a.db"));
    query.text = "wood";
    const auto without = reopened->search(query);
    ASSERT_TRUE(without);
    EXPECT_EQ(without->total, 20);
    EXPECT_THAT(without->understood, testing::Contains(HasSubstr("cannot be used")));
    EXPECT_FALSE(reopened->use_image_text_model(model));
    EXPECT_EQ(reopened->image_text_model(), model) << "the one before stays";
    ASSERT_TRUE(reopened->use_image_text_model(""));
    EXPECT_EQ(reopened->image_text_model(), "");
    EXPECT_THAT(reopened->search(query)->understood,
                testing::Not(testing::Contains(HasSubstr("cannot be used"))));
}

}  // namespace
}  // namespace weft
