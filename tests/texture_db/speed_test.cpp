// Figures for docs/TEXTURES.md: printed, not judged. One thread.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "engine/core/parallel.h"
#include "tests/texture_db/scratch.h"
#include "texture_db/catalogue/index.h"
#include "texture_db/describe/features.h"
#include "texture_db/library/library.h"
#include "texture_db/recommend/region_look.h"
#include "texture_db/recommend/suggestions.h"

namespace weft {
namespace {

template <class Work>
double seconds(Work work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

TEST(Speed, OfAFullLibrary) {
    set_thread_count(1);
    const Scratch scratch;
    const std::string path = scratch.at("full.db");
    constexpr int kSamples = 15'000, kBatch = 500;
    const char* materials[]{"stone", "wood", "brick",  "metal",
                            "grass", "sand", "fabric", "leather"};
    {
        const auto library = open_or_die(path);
        double adding = 0;
        for (int at = 0; at < kSamples; at += kBatch) {
            std::vector<NewTexture> batch;
            for (int i = at; i < at + kBatch; ++i)
                batch.push_back(new_texture(static_cast<std::uint64_t>(i), materials[i % 8],
                                            std::string(materials[i % 8]) + " " + std::to_string(i),
                                            60 + i % 8 * 20, 200 - i % 8 * 15, 40 + i % 5 * 30));
            adding += seconds([&] { ASSERT_TRUE(library->add(batch)); });
        }
        std::printf("adding %d samples: %.0f a second on one thread\n", kSamples,
                    kSamples / adding);
        std::printf("learning the descriptor: %.2f s\n",
                    seconds([&] { ASSERT_TRUE(library->train_descriptor()); }));
    }
    std::shared_ptr<TextureLibrary> library;
    std::printf("opening: %.1f ms\n", 1e3 * seconds([&] {
                                          library = open_or_die(path);
                                          ASSERT_TRUE(library->size());
                                      }));
    SearchQuery query;
    query.text = "rough grey stone";
    std::printf("first search (reads the catalogue): %.1f ms\n",
                1e3 * seconds([&] { ASSERT_TRUE(library->search(query)); }));
    for (const char* words : {"stone", "rough grey stone", "timbr", "dark green fabric"}) {
        query.text = words;
        std::printf("search '%s': %.1f ms\n", words,
                    1e3 * seconds([&] { ASSERT_TRUE(library->search(query)); }));
    }
    const std::string id = library->search(query)->hits.empty()
                               ? library->search({})->hits[0].id
                               : library->search(query)->hits[0].id;
    std::printf("similar: %.1f ms\n",
                1e3 * seconds([&] { ASSERT_TRUE(library->similar(id, 20)); }));
    std::printf("thumbnail: %.2f ms\n",
                1e3 * seconds([&] { ASSERT_TRUE(library->thumbnail(id)); }));
    const ImageU8x3 plate = noise_picture(480, 7);
    Matte matte(480, 480);
    for (int y = 100; y < 300; ++y)
        for (int x = 100; x < 300; ++x)
            matte.at(x, y) = 255;
    RecommendRequest request;
    request.plate = plate;
    request.regions = {{"r", matte.view(), "", ""}};
    std::printf("recommend for one region: %.1f ms\n",
                1e3 * seconds([&] { ASSERT_TRUE(library->recommend(request)); }));
    set_thread_count(0);
}

// Generated, like no real library: what is measured is how the work grows.
SampleIndex many_samples(std::size_t count) {
    SampleIndex index;
    Rng rng(1);
    std::vector<float> descriptor(32);
    for (int m = 0; m < 32; ++m)
        index.materials.number_of("material " + std::to_string(m));
    index.packages.number_of("");
    index.licences.number_of("CC0-1.0");
    index.categories.number_of("");
    for (std::size_t i = 0; i < count; ++i) {
        IndexedSample s;
        s.key = static_cast<std::int64_t>(i);
        s.id = std::to_string(i);
        s.source = "picture " + std::to_string(i / 12);
        s.material = static_cast<int>(rng.below(32));
        s.origin = TextureOrigin::kPackage;
        s.synthesis = static_cast<float>(rng.uniform());
        for (float& v : s.measured.attributes.values)
            v = static_cast<float>(rng.uniform());
        s.measured.mean = {static_cast<float>(100 * rng.uniform()),
                           static_cast<float>(60 * rng.uniform() - 30),
                           static_cast<float>(60 * rng.uniform() - 30)};
        for (float& v : descriptor)
            v = static_cast<float>(rng.uniform());
        index.add(std::move(s), descriptor);
    }
    return index;
}

TEST(Speed, OfTwoHundredThousandDescriptors) {
    set_thread_count(1);
    const SampleIndex index = many_samples(200'000);
    const auto asked = index.descriptor(100);
    std::vector<Neighbour> found;
    std::printf("20 nearest of 200,000: %.1f ms\n",
                1e3 * seconds([&] { found = nearest(index, asked, 20); }));
    ASSERT_EQ(found.size(), 20u);
    EXPECT_EQ(found[0].sample, 100u);

    const ImageU8x3 plate = noise_picture(480, 7);
    Matte matte(480, 480);
    for (int y = 100; y < 400; ++y)
        for (int x = 100; x < 400; ++x)
            matte.at(x, y) = 255;
    RecommendRequest request;
    request.plate = plate;
    const RegionRequest region{"r", matte.view(), "", ""};
    RegionSuggestions suggested;
    std::printf("recommend out of 200,000: %.1f ms\n",
                1e3 * seconds([&] {
                    auto look = look_at_region(plate, region, nullptr);
                    ASSERT_TRUE(look);
                    // The four patches have descriptors as a trained library gives them.
                    for (std::size_t i = 0; i < 4; ++i) {
                        const auto d = index.descriptor(i);
                        static_cast<void>(
                            texture_features(middle_sample(plate.view().crop({0, 0, 96, 96}))));
                        look->descriptors.emplace_back(d.begin(), d.end());
                    }
                    const RegionScorer scorer(index, request, region, *look);
                    suggested = suggest_for(index, request, region, *look, scorer);
                }));
    EXPECT_EQ(suggested.suggestions.size(), 12u);
    set_thread_count(0);
}

}  // namespace
}  // namespace weft
