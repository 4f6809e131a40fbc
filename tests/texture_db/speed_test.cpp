// Figures for docs/TEXTURES.md: printed, not judged. One thread.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "engine/core/parallel.h"
#include "tests/texture_db/scratch.h"
#include "texture_db/index.h"
#include "texture_db/library.h"

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

TEST(Speed, OfTwoHundredThousandDescriptors) {
    SampleIndex index;
    index.descriptor_size = 32;
    Rng rng(1);
    constexpr std::size_t kCount = 200'000;
    index.samples.resize(kCount);
    index.descriptors.resize(kCount * 32);
    std::generate(index.descriptors.begin(), index.descriptors.end(),
                  [&] { return static_cast<float>(rng.uniform()); });
    const std::vector<float> asked(index.descriptors.begin() + 3200,
                                   index.descriptors.begin() + 3232);
    std::vector<Neighbour> found;
    std::printf("20 nearest of 200,000: %.1f ms\n",
                1e3 * seconds([&] { found = nearest(index, asked, 20); }));
    ASSERT_EQ(found.size(), 20u);
    EXPECT_EQ(found[0].sample, 100u);
}

}  // namespace
}  // namespace weft
