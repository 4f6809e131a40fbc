#include "texture_db/describe/image_text_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <opencv2/core.hpp>
#include <opencv2/dnn.hpp>

#include "engine/core/hash.h"
#include "engine/core/input_file.h"
#include "engine/core/text.h"
#include "texture_db/describe/material_words.h"
#include "texture_db/describe/sample_codec.h"

namespace weft {
struct ModelDescription {
    std::string name, image, words;
    int size = 224;
    std::array<float, 3> mean{0, 0, 0}, deviation{1, 1, 1};
    float scale = 100;
};

namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

constexpr std::uintmax_t kMostBytes = std::uintmax_t{2} << 30;

tl::unexpected<Error> unusable(const std::string& folder, const std::string& why) {
    return fail(ErrorCode::kUnreadable,
                "The image–text model " + folder + " cannot be used: " + why + ".",
                "See docs/TEXTURES.md for what its folder holds.");
}

Expected<std::string> contents(const std::string& folder, const std::string& file) {
    const std::string path = folder + "/" + file;
    std::error_code fault;
    if (!fs::exists(path, fault)) return unusable(folder, file + " is missing");
    auto text = read_file(path, "The model's file", kMostBytes);
    if (!text) return unusable(folder, text.error().sentence());
    return text;
}

// True for a name in the folder, without a path.
bool plain(const std::string& file) {
    return !file.empty() && file.find('/') == std::string::npos && file != "." && file != "..";
}

Expected<ModelDescription> description_of(const std::string& folder, const std::string& text) {
    ModelDescription d;
    try {
        const Json json = Json::parse(text);
        d.name = json.value("name", fs::path(folder).filename().string());
        d.image = json.at("image").get<std::string>();
        d.words = json.at("words").get<std::string>();
        d.size = json.value("size", d.size);
        d.mean = json.value("mean", d.mean);
        d.deviation = json.value("deviation", d.deviation);
        d.scale = json.value("scale", d.scale);
    } catch (const Json::exception&) {
        return unusable(folder, "model.json is not JSON with the required keys");
    }
    const bool sane = plain(d.image) && plain(d.words) && d.size >= 16 && d.size <= 1024 &&
                      d.scale > 0 && d.scale <= 1000 && d.deviation[0] > 0 && d.deviation[1] > 0 &&
                      d.deviation[2] > 0;
    if (!sane) return unusable(folder, "model.json holds a value out of its range");
    return d;
}

void make_unit(std::vector<float>& v) {
    const float length = std::sqrt(std::inner_product(v.begin(), v.end(), v.begin(), 0.0f));
    for (float& x : v)
        x = length > 0 ? x / length : 0;
}

}  // namespace

struct ImageTextModel::Parts {
    ModelDescription described;
    std::string identity;
    cv::dnn::Net net;
    std::map<std::string, std::vector<float>, std::less<>> words;
    int dimensions = 0;
};

ImageTextModel::ImageTextModel(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
ImageTextModel::ImageTextModel(ImageTextModel&&) noexcept = default;
ImageTextModel& ImageTextModel::operator=(ImageTextModel&&) noexcept = default;
ImageTextModel::~ImageTextModel() = default;

const std::string& ImageTextModel::name() const {
    return parts_->described.name;
}
const std::string& ImageTextModel::identity() const {
    return parts_->identity;
}
int ImageTextModel::dimensions() const {
    return parts_->dimensions;
}

Expected<ImageTextModel> ImageTextModel::open(const std::string& folder) {
    auto parts = std::make_unique<Parts>();
    WEFT_TRY(text, contents(folder, "model.json"));
    WEFT_TRY(described, description_of(folder, text));
    parts->described = std::move(described);
    WEFT_TRY(network, contents(folder, parts->described.image));
    WEFT_TRY(words, contents(folder, parts->described.words));
    Hasher hasher;
    hasher.text(text).text(network).text(words);
    parts->identity = hasher.finish().hex();
    try {
        const Json table = Json::parse(words);
        for (const auto& [word, vector] : table.items()) {
            auto values = vector.get<std::vector<float>>();
            make_unit(values);
            parts->words.emplace(lower_case(word), std::move(values));
        }
    } catch (const Json::exception&) {
        return unusable(folder,
                        parts->described.words + " is not a JSON object of lists of numbers");
    }
    if (parts->words.size() < 2)
        return unusable(folder, parts->described.words + " holds fewer than two words");
    try {
        parts->net = cv::dnn::readNetFromONNX(network.data(), network.size());
    } catch (const cv::Exception& e) {
        return unusable(folder, "OpenCV cannot read " + parts->described.image + ": " + e.err);
    }
    ImageTextModel model(std::move(parts));
    // The length of its vectors is known only after a picture was encoded.
    const ImageU8x3 grey(32, 32, 128);
    auto seen = model.encode_image(grey);
    if (!seen) return unusable(folder, seen.error().sentence());
    model.parts_->dimensions = static_cast<int>(seen->size());
    for (const auto& [word, vector] : model.parts_->words) {
        if (vector.size() == seen->size()) continue;
        return unusable(folder, "the word '" + word + "' has " + std::to_string(vector.size()) +
                                    " numbers, the network gives " + std::to_string(seen->size()));
    }
    return model;
}

Expected<std::vector<float>> ImageTextModel::encode_image(ViewU8x3 picture) {
    const ModelDescription& d = parts_->described;
    const ImageU8x3 fitted = resized(picture, {d.size, d.size});
    const std::array<int, 4> shape{1, 3, d.size, d.size};
    cv::Mat input(4, shape.data(), CV_32F);
    for (int c = 0; c < 3; ++c) {
        const auto channel = static_cast<std::size_t>(c);
        for (int y = 0; y < d.size; ++y) {
            float* row = input.ptr<float>(0, c, y);
            for (int x = 0; x < d.size; ++x)
                row[x] = (static_cast<float>(fitted.at(x, y, c)) / 255 - d.mean[channel]) /
                         d.deviation[channel];
        }
    }
    try {
        parts_->net.setInput(input);
        const cv::Mat output = parts_->net.forward();
        std::vector<float> out(output.ptr<float>(), output.ptr<float>() + output.total());
        make_unit(out);
        return out;
    } catch (const cv::Exception& e) {
        return fail(ErrorCode::kUnreadable, "OpenCV cannot run " + d.image + ": " + e.err);
    }
}

std::vector<float> ImageTextModel::encode_text(std::string_view text) const {
    std::vector<float> sum;
    for (const std::string& word : split_words(lower_case(text))) {
        auto found = parts_->words.find(word);
        if (found == parts_->words.end()) found = parts_->words.find(singular(word));
        if (found == parts_->words.end()) continue;
        sum.resize(found->second.size());
        for (std::size_t i = 0; i < sum.size(); ++i)
            sum[i] += found->second[i];
    }
    make_unit(sum);
    return sum;
}

std::vector<float> ImageTextModel::likelihoods(std::span<const float> seen,
                                               const std::vector<std::string>& words) const {
    constexpr float kUnknown = -2;  // below every cosine
    std::vector<float> cosines(words.size(), kUnknown);
    for (std::size_t i = 0; i < words.size(); ++i) {
        const auto found = parts_->words.find(words[i]);
        if (found != parts_->words.end() && found->second.size() == seen.size())
            cosines[i] = std::inner_product(seen.begin(), seen.end(), found->second.begin(), 0.0f);
    }
    const float most = cosines.empty() ? 0 : *std::max_element(cosines.begin(), cosines.end());
    std::vector<float> out(words.size());
    float sum = 0;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (cosines[i] <= kUnknown) continue;
        sum += out[i] = std::exp(parts_->described.scale * (cosines[i] - most));
    }
    for (float& value : out)
        value = sum > 0 ? value / sum : 0;
    return out;
}

}  // namespace weft
