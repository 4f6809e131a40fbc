#include "texture_db/library/library.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <thread>

#include "tests/texture_db/scratch.h"

namespace weft {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

void run_sql(const std::string& path, const char* sql) {
    sqlite3* db = nullptr;
    ASSERT_EQ(sqlite3_open(path.c_str(), &db), SQLITE_OK);
    char* fault = nullptr;
    ASSERT_EQ(sqlite3_exec(db, sql, nullptr, nullptr, &fault), SQLITE_OK) << fault;
    sqlite3_close(db);
}

TEST(Library, GivesBackTheVeryPixels) {
    const Scratch scratch;
    const auto library = open_or_die(scratch.at("a.db"));
    ASSERT_TRUE(library);
    const NewTexture one = new_texture(1, "stone", "grey stone"),
                     two = new_texture(2, "wood", "oak");
    ASSERT_EQ(library->add({one, two}), 2);
    SearchQuery query;
    query.text = "oak";
    const auto found = library->search(query);
    ASSERT_TRUE(found && found->hits.size() == 1u);
    EXPECT_EQ(*library->thumbnail(found->hits[0].id), two.pixels);
    const auto info = library->info(found->hits[0].id.substr(0, 8));
    ASSERT_TRUE(info);
    EXPECT_EQ(info->name, "oak");
    EXPECT_EQ(info->author, "Ada");
    EXPECT_EQ(info->licence, "CC-BY-4.0");
}

TEST(Library, TakesTheSamePixelsOnce) {
    const Scratch scratch;
    const auto library = open_or_die(scratch.at("a.db"));
    EXPECT_EQ(library->add({new_texture(1, "stone", "a")}), 1);
    EXPECT_EQ(library->add({new_texture(1, "wood", "b"), new_texture(3, "wood", "c")}), 1);
    EXPECT_EQ(library->size(), 2);
}

TEST(Library, RefusesASampleOfAnotherSize) {
    const Scratch scratch;
    const auto library = open_or_die(scratch.at("a.db"));
    NewTexture t = new_texture(1, "stone", "a");
    t.pixels = noise_picture(64, 1);
    const auto added = library->add({new_texture(2, "stone", "b"), t});
    ASSERT_FALSE(added);
    EXPECT_EQ(library->size(), 0) << "all or none";
}

TEST(Library, KeepsWhatTheArtistKeepsOverReopening) {
    const Scratch scratch;
    std::string id, other;
    {
        const auto library = open_or_die(scratch.at("a.db"));
        ASSERT_TRUE(library->add({new_texture(1, "stone", "a"), new_texture(2, "wood", "b")}));
        const auto all = library->search({});
        id = all->hits[0].id;
        other = all->hits[1].id;
        EXPECT_TRUE(library->set_favourite(id, true));
        EXPECT_TRUE(library->set_rating(id, 4));
        EXPECT_FALSE(library->set_rating(id, 6));
        EXPECT_TRUE(library->mark_used(id));
        EXPECT_TRUE(library->mark_used(other));
        EXPECT_TRUE(library->add_to_collection("castle", id));
        SearchQuery query;
        query.text = "rough stone";
        query.excluded_licences = {"GPL"};
        EXPECT_TRUE(library->save_search("walls", query));
    }
    const auto library = open_or_die(scratch.at("a.db"));
    const auto info = library->info(id);
    EXPECT_TRUE(info->favourite);
    EXPECT_EQ(info->rating, 4);
    EXPECT_THAT(*library->recent(10), ElementsAre(other, id));
    SearchQuery query;
    query.collection = "castle";
    ASSERT_EQ(library->search(query)->total, 1);
    EXPECT_EQ(library->search(query)->hits[0].id, id);
    query = {};
    query.favourites_only = true;
    EXPECT_EQ(library->search(query)->total, 1);
    const auto saved = library->saved_searches();
    ASSERT_EQ(saved->size(), 1u);
    EXPECT_EQ((*saved)[0].query.text, "rough stone");
    EXPECT_THAT((*saved)[0].query.excluded_licences, ElementsAre("GPL"));
}

TEST(Library, MovesAnOldFileUpAndKeepsItsSamples) {
    const Scratch scratch;
    const std::string path = scratch.at("a.db");
    {
        const auto library = open_or_die(path);
        ASSERT_TRUE(library->add({new_texture(1, "stone", "a")}));
    }
    // Version 1 had no tables for what the artist keeps.
    run_sql(path,
            "DROP TABLE favourite; DROP TABLE rating; DROP TABLE recent; DROP TABLE collection; "
            "DROP TABLE saved_search; DROP TABLE sight; PRAGMA user_version = 1");
    LibraryOptions reading;
    reading.read_only = true;
    EXPECT_FALSE(TextureLibrary::open(path, reading)) << "a reader may not change the file";
    const auto library = open_or_die(path);
    ASSERT_TRUE(library);
    EXPECT_EQ(library->size(), 1);
    EXPECT_EQ(library->stats()->schema_version, 4);
    EXPECT_TRUE(library->set_favourite(library->search({})->hits[0].id, true));
}

TEST(Library, RefusesForeignNewerAndDamagedFiles) {
    const Scratch scratch;
    run_sql(scratch.at("foreign.db"), "CREATE TABLE t(x)");
    const auto foreign = TextureLibrary::open(scratch.at("foreign.db"));
    ASSERT_FALSE(foreign);
    EXPECT_THAT(foreign.error().sentence(), HasSubstr("not a texture library"));

    { ASSERT_TRUE(open_or_die(scratch.at("newer.db"))); }
    run_sql(scratch.at("newer.db"), "PRAGMA user_version = 99");
    const auto newer = TextureLibrary::open(scratch.at("newer.db"));
    ASSERT_FALSE(newer);
    EXPECT_THAT(newer.error().sentence(), HasSubstr("newer version"));

    std::ofstream(scratch.at("text.db")) << std::string(5000, 'x');
    const auto text = TextureLibrary::open(scratch.at("text.db"));
    ASSERT_FALSE(text);
    EXPECT_EQ(text.error().code, ErrorCode::kUnreadable);
    EXPECT_THAT(text.error().sentence(), HasSubstr("damaged"));

    LibraryOptions no_create;
    no_create.create = false;
    EXPECT_FALSE(TextureLibrary::open(scratch.at("none.db"), no_create));
    EXPECT_FALSE(std::filesystem::exists(scratch.at("none.db")));
}

TEST(Library, VerifyFindsWhatWasChanged) {
    const Scratch scratch;
    const std::string path = scratch.at("a.db");
    {
        const auto library = open_or_die(path);
        ASSERT_TRUE(library->add({new_texture(1, "stone", "a"), new_texture(2, "stone", "b"),
                                  new_texture(3, "stone", "c")}));
        EXPECT_THAT(*library->verify(), testing::IsEmpty());
    }
    run_sql(path,
            "UPDATE pixels SET png = (SELECT png FROM pixels WHERE sample = 2) WHERE sample = 1; "
            "UPDATE pixels SET png = x'00' WHERE sample = 3");
    const auto library = open_or_die(path);
    EXPECT_EQ(library->verify()->size(), 2u);
}

TEST(Library, TwoProcessesAddSideBySide) {
    const Scratch scratch;
    const std::string path = scratch.at("a.db");
    ASSERT_TRUE(open_or_die(path));
    const pid_t child = ::fork();
    if (child == 0) {
        const auto mine = open_or_die(path);
        bool good = mine != nullptr;
        for (std::uint64_t i = 0; good && i < 20; ++i)
            good = mine->add({new_texture(1000 + i, "wood", "child")}).has_value();
        ::_exit(good ? 0 : 1);
    }
    const auto library = open_or_die(path);
    for (std::uint64_t i = 0; i < 20; ++i)
        ASSERT_TRUE(library->add({new_texture(i, "stone", "parent")}));
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
    EXPECT_EQ(library->size(), 40);
    EXPECT_EQ(library->search({})->total, 40) << "the other process's samples are seen";
}

TEST(Library, SearchesWhileAnotherThreadAdds) {
    const Scratch scratch;
    const auto library = open_or_die(scratch.at("a.db"));
    ASSERT_TRUE(library->add({new_texture(1, "stone", "a")}));
    std::jthread writer([&] {
        for (std::uint64_t i = 10; i < 40; ++i)
            ASSERT_TRUE(library->add({new_texture(i, "stone", "more")}));
    });
    int last = 0;
    for (int i = 0; i < 30; ++i) {
        const auto found = library->search({});
        ASSERT_TRUE(found);
        EXPECT_GE(found->total, last);
        last = found->total;
    }
    writer.join();
    EXPECT_EQ(library->search({})->total, 31);
}

TEST(Library, AFullDiskLosesNothing) {
    const Scratch scratch;
    const std::string path = scratch.at("a.db");
    {
        const auto library = open_or_die(path);
        ASSERT_TRUE(library->add({new_texture(1, "stone", "a")}));
    }
    // A limit on the size of files stands in for a disk that is full.
    const pid_t child = ::fork();
    if (child == 0) {
        ::signal(SIGXFSZ, SIG_IGN);
        rlimit limit{400'000, 400'000};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        const auto library = open_or_die(path);
        for (std::uint64_t i = 10; library && i < 200; ++i) {
            const auto added = library->add({new_texture(i, "stone", "more")});
            if (!added) ::_exit(added.error().code == ErrorCode::kNoSpace ? 0 : 2);
        }
        ::_exit(3);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(WEXITSTATUS(status), 0) << "the error is 'no space'";
    const auto library = open_or_die(path);
    ASSERT_TRUE(library);
    EXPECT_GE(*library->size(), 1);
    EXPECT_THAT(*library->verify(), testing::IsEmpty());
}

TEST(Library, MeasuresAnewWhatAnOlderVersionMeasured) {
    const Scratch scratch;
    const std::string path = scratch.at("a.db");
    {
        const auto library = open_or_die(path);
        std::vector<NewTexture> textures;
        for (std::uint64_t i = 0; i < 24; ++i)
            textures.push_back(i % 2 ? new_texture(i, "stone", "a", 90, 90, 90)
                                     : new_texture(i, "grass", "b", 60, 160, 50));
        ASSERT_TRUE(library->add(textures));
    }
    run_sql(path,
            "UPDATE features SET version = 1, data = x'00'; DELETE FROM features WHERE sample = 1");
    const auto library = open_or_die(path);
    ASSERT_TRUE(library->train_descriptor());
    EXPECT_EQ(library->stats()->descriptor_samples, 24);
    const auto alike = library->similar(noise_picture(96, 99, 90, 90, 90), 5);
    ASSERT_TRUE(alike) << alike.error().text();
    EXPECT_EQ(alike->at(0).material, "stone");
}

TEST(Library, TakesOverAnotherWhole) {
    const Scratch scratch;
    const std::string from = scratch.at("a library?#%.db");
    std::string id;
    {
        const auto library = open_or_die(from);
        std::vector<NewTexture> textures;
        for (std::uint64_t i = 0; i < 24; ++i)
            textures.push_back(i % 2 ? new_texture(i, "stone", "a", 90, 90, 90)
                                     : new_texture(i, "grass", "b", 60, 160, 50));
        ASSERT_TRUE(library->add(textures));
        ASSERT_TRUE(library->train_descriptor());
        ASSERT_TRUE(library->set_note("made", "all"));
        id = library->search({})->hits[0].id;
    }
    const auto library = open_or_die(scratch.at("b.db"));
    EXPECT_EQ(library->copy_from(from, "made", "half"), false) << "it is not what was wanted";
    ASSERT_EQ(library->copy_from(from, "made", "all"), true);
    EXPECT_EQ(library->size(), 24);
    EXPECT_EQ(library->note("made"), "all");
    EXPECT_TRUE(library->thumbnail(id));
    EXPECT_EQ(library->similar(id, 5)->size(), 5u);
    SearchQuery words;
    words.text = "grass";
    EXPECT_EQ(library->search(words)->total, 12);
    EXPECT_THAT(*library->verify(), testing::IsEmpty());
    EXPECT_EQ(library->copy_from(from, "made", "all"), false) << "it is not empty any more";
    EXPECT_EQ(library->size(), 24);
    EXPECT_FALSE(library->copy_from(scratch.at("none.db"), "made", "all"));
    EXPECT_TRUE(library->add({new_texture(99, "stone", "c")})) << "what was attached is let go";
}

TEST(Library, ShortensIdsAndRefusesOthers) {
    const Scratch scratch;
    const auto library = open_or_die(scratch.at("a.db"));
    ASSERT_TRUE(library->add({new_texture(1, "stone", "a")}));
    const std::string id = library->search({})->hits[0].id;
    EXPECT_EQ(library->info("db:" + id.substr(0, 6))->id, id);
    EXPECT_EQ(library->info("brick").error().code, ErrorCode::kUsage);
    EXPECT_EQ(library->info("abc").error().code, ErrorCode::kUsage);
    EXPECT_EQ(library->info("ffffffffffff").error().code, ErrorCode::kUnreadable);
    const auto resolved = resolve_texture(library->path(), "db:" + id);
    ASSERT_TRUE(resolved);
    EXPECT_EQ(resolved->pixels, *library->thumbnail(id));
    EXPECT_EQ(resolved->credit.licence, "CC-BY-4.0");
    const auto kept = keep_texture(library->path(), id, scratch.at("project/textures"));
    ASSERT_TRUE(kept) << kept.error().text();
    const auto credit = read_texture_credit(*kept);
    ASSERT_TRUE(credit);
    EXPECT_EQ(credit->author, "Ada");
    EXPECT_EQ(credit->id, id);
    EXPECT_FALSE(read_texture_credit(scratch.at("other.png")));
}

}  // namespace
}  // namespace weft
