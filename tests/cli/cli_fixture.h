#pragma once
// A small shot in a temporary folder, and the program run on it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "engine/core/image.h"
#include "engine/media/frame_writer.h"
#include "engine/media/movies.h"
#include "tests/cli/card_scene.h"
#include "tests/cli/weft_process.h"

namespace weft::test {

using Words = std::vector<std::string>;

/// For tests that read or write movies.
#define WEFT_NEEDS_MOVIES() \
    if (movie_library().empty()) GTEST_SKIP() << "this build has no movies"

/// Joins `words` and `more`; options in `more` replace those of the same name, except --matte.
Words with_options(Words words, const Words& more);

/// The shot: frames/####.png, masks/####.png, tile.png (a plane), sample.png (96×96).
class CliTest : public ::testing::Test {
  protected:
    void SetUp() override;
    void TearDown() override { std::filesystem::remove_all(folder_); }

    /// Frames first … first + count − 1 of the shot, changed by `edit` if given.
    using PlateEdit = std::function<void(int frame, ImageF3& plate)>;
    void make_shot(int count, int first = 1, const std::string& extension = ".png",
                   PixelDepth depth = PixelDepth::kU8, const PlateEdit& edit = {});

    std::string in(const std::string& name) const { return (folder_ / name).string(); }
    Outcome run(const Words& arguments) const { return run_weft(arguments, options_); }
    /// `weft replace` on the shot with the ready plane, in draft quality, and `more`.
    Words replace(const Words& more = {}) const;
    Outcome run_replace(const Words& more = {}) const { return run(replace(more)); }

    /// Names in a folder, hidden ones too, ascending; none when the folder is missing.
    Words names(const std::string& folder) const;
    /// A hash of every file of a folder, by name.
    std::map<std::string, std::string> contents(const std::string& folder) const;
    std::string bytes(const std::string& name) const;
    void put(const std::string& name, const std::string& bytes) const;
    void put_picture(const std::string& name, const ImageF3& image,
                     PixelDepth depth = PixelDepth::kU8) const;
    void put_matte(const std::string& name, const Matte& matte) const;
    PlateFrame picture(const std::string& name) const;

    std::filesystem::path folder_;
    ProcessOptions options_;
};

/// Expects `text` to be one line of Weft that contains all `parts`.
void expect_one_line(const std::string& text, const Words& parts);
/// Expects the run to fail with `exit` and one line that contains all `parts`.
void expect_failure(const Outcome& outcome, int exit, const Words& parts);
void expect_success(const Outcome& outcome);

}  // namespace weft::test
