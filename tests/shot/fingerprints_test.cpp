// What is known of files without reading them: which of them are read again, and when.
#include "app/shot/fingerprints.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>

#include "app/shot/fingerprint_file.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

class FingerprintsTest : public ::testing::Test {
  protected:
    void SetUp() override { fs::create_directories(folder_ / "in"); }
    void TearDown() override { fs::remove_all(folder_); }
    std::string in(const std::string& name) const { return (folder_ / "in" / name).string(); }
    std::string kept() const { return (folder_ / "kept").string(); }
    void put(const std::string& name, const std::string& text) const {
        std::ofstream(in(name), std::ios::binary | std::ios::trunc) << text;
    }
    Hash128 bytes_of(const std::string& name) const { return hash_of_contents(in(name)).value(); }
    // Writes until the change shows in the stamp, whose clock counts in steps of milliseconds.
    template <class Change>
    void change(const std::string& name, Change&& write) const {
        const auto before = stamp_of(in(name));
        do {
            write();
        } while (stamp_of(in(name)) == before);
    }
    // As if all files had been there for a while.
    static std::optional<FileStamp> stamp_of_old(const std::string& path) {
        auto stamp = stamp_of(path);
        if (stamp) stamp->changed_ns -= 3'600'000'000'000;
        return stamp;
    }
    // As if a write had left size, times and inode as they were.
    static std::optional<FileStamp> same_stamp(const std::string& path) {
        auto stamp = stamp_of(path);
        if (stamp) stamp = FileStamp{stamp->bytes, 1, 1, 1, 1};
        return stamp;
    }

    const fs::path folder_ =
        fs::temp_directory_path() / ("weft_fingerprints_" + std::to_string(getpid()));
};

TEST_F(FingerprintsTest, AreTheHashesOfTheBytesAndReadOnce) {
    put("a", "one");
    put("b", "two");
    Fingerprints prints;
    prints.read({in("a"), in("b"), in("missing")});
    EXPECT_EQ(prints.files_read(), 2);
    EXPECT_EQ(prints.contents(in("a")).value(), bytes_of("a"));
    EXPECT_EQ(prints.contents(in("../in/b")).value(), bytes_of("b"));
    EXPECT_EQ(prints.files_read(), 2);
    EXPECT_EQ(prints.contents(in("missing")).error().code, ErrorCode::kUnreadable);
    EXPECT_EQ(prints.id(in("missing")).error().code, ErrorCode::kUnreadable);
}

TEST_F(FingerprintsTest, OtherBytesOfTheSameSizeAndTimeAreFound) {
    for (const bool read : {false, true}) {
        put("a", "one");
        Fingerprints prints({}, stamp_of_old);
        if (read) prints.read({in("a")});
        const Hash128 id = prints.id(in("a")).value();
        const auto time = fs::last_write_time(in("a"));
        change("a", [&] {
            put("a", "two");
            fs::last_write_time(in("a"), time);
        });
        const Hash128 next = prints.id(in("a")).value();
        EXPECT_NE(next, id);
        EXPECT_EQ(prints.contents(in("a")).value(), bytes_of("a"));
        // Another file moved into its place, as programs save.
        put("new", "six");
        fs::last_write_time(in("new"), time);
        fs::rename(in("new"), in("a"));
        EXPECT_NE(prints.id(in("a")).value(), next);
        EXPECT_EQ(prints.contents(in("a")).value(), bytes_of("a"));
    }
}

TEST_F(FingerprintsTest, ATouchedOrCopiedFileIsTheSame) {
    put("a", "one");
    Fingerprints prints(kept(), stamp_of_old);
    const Hash128 one = prints.contents(in("a")).value(), id = prints.id(in("a")).value();
    change("a", [&] { fs::last_write_time(in("a"), fs::file_time_type::clock::now()); });
    EXPECT_EQ(prints.id(in("a")).value(), id);
    prints.save();
    fs::copy_file(in("a"), in("copy"));
    fs::rename(in("copy"), in("a"));
    EXPECT_EQ(prints.id(in("a")).value(), id);
    EXPECT_EQ(prints.contents(in("a")).value(), one);
    EXPECT_EQ(Fingerprints(kept(), stamp_of_old).id(in("a")).value(), id) << "by a later run";
}

TEST_F(FingerprintsTest, AnIdNeedsNoMoreThanASampleAndStaysWhenTheFileIsRead) {
    put("a", std::string(100'000, 'x'));
    Fingerprints prints(kept(), stamp_of_old);
    const Hash128 id = prints.id(in("a")).value();
    EXPECT_EQ(prints.files_read(), 0);
    EXPECT_TRUE(prints.contents(in("a")));
    EXPECT_EQ(prints.id(in("a")).value(), id);
    prints.save();
    EXPECT_EQ(Fingerprints(kept(), stamp_of_old).id(in("a")).value(), id);
    EXPECT_EQ(Fingerprints({}, stamp_of_old).id(in("a")).value(), id) << "nothing is kept there";
}

TEST_F(FingerprintsTest, ALaterRunReadsNoMoreThanASample) {
    put("a", std::string(100'000, 'x'));
    put("b", "two");
    const Hash128 a = Fingerprints(kept(), stamp_of_old).contents(in("a")).value();
    {
        Fingerprints later(kept(), stamp_of_old);
        EXPECT_EQ(later.contents(in("a")).value(), a);
        EXPECT_EQ(later.files_read(), 0);
        EXPECT_EQ(later.contents(in("b")).value(), bytes_of("b"));
    }
    Fingerprints last(kept(), stamp_of_old);
    last.read({in("a"), in("b")});
    EXPECT_EQ(last.files_read(), 0) << "what the second run found is kept beside the first one's";
    // What was written just now may have been written again with the same time.
    put("c", "three");
    const Hash128 id = [&] {
        Fingerprints first(kept());
        EXPECT_TRUE(first.contents(in("c")));
        EXPECT_TRUE(first.contents(in("c")));
        EXPECT_EQ(first.files_read(), 1);
        return first.id(in("c")).value();
    }();
    Fingerprints young(kept());
    EXPECT_EQ(young.id(in("c")).value(), id);
    EXPECT_EQ(young.files_read(), 1);
}

TEST_F(FingerprintsTest, TheSampleFindsAChangeThatTheStampHides) {
    put("a", std::string(100'000, 'x'));
    Hash128 id = [&] {
        Fingerprints first(kept(), same_stamp);
        EXPECT_TRUE(first.contents(in("a")));
        return first.id(in("a")).value();
    }();
    for (const std::size_t at : {std::size_t{0}, std::size_t{50'000}, std::size_t{99'999}}) {
        std::string text(100'000, 'x');
        text[at] = 'y';
        put("a", text);
        Fingerprints later(kept(), same_stamp);
        EXPECT_EQ(later.contents(in("a")).value(), bytes_of("a")) << at;
        EXPECT_NE(later.id(in("a")).value(), id) << at;
        id = later.id(in("a")).value();
    }
}

TEST_F(FingerprintsTest, ADamagedOrMissingFolderCostsTimeOnly) {
    put("a", "one");
    EXPECT_TRUE(Fingerprints(kept(), stamp_of_old).contents(in("a")));
    for (const auto& entry : fs::directory_iterator(kept())) {
        const auto size = fs::file_size(entry);
        EXPECT_EQ(read_fingerprints(entry.path().string()).size(), 1u);
        fs::resize_file(entry, size - 1);
        EXPECT_TRUE(read_fingerprints(entry.path().string()).empty());
    }
    Fingerprints later(kept(), stamp_of_old);
    EXPECT_EQ(later.contents(in("a")).value(), bytes_of("a"));
    EXPECT_EQ(later.files_read(), 1);
    put("file", "in the way");
    EXPECT_EQ(Fingerprints(in("file"), stamp_of_old).contents(in("a")).value(), bytes_of("a"));
}

TEST_F(FingerprintsTest, AreHandedToAnotherFolder) {
    put("a", "one");
    Fingerprints prints({}, stamp_of_old);
    EXPECT_TRUE(prints.contents(in("a")));
    prints.save_to(kept());
    Fingerprints there(kept(), stamp_of_old);
    EXPECT_TRUE(there.contents(in("a")));
    EXPECT_EQ(there.files_read(), 0);
}

}  // namespace
}  // namespace weft
