// A disk that fails at any call: no frame is ever partial, older frames stay, and a resumed run
// gives the bytes of an undisturbed one.
#include "engine/media/image_files.h"
#include "tests/cli/cli_fixture.h"
#include "tests/support/places.h"

namespace weft::test {
namespace {

namespace fs = std::filesystem;

struct Fault {
    std::string call, kind, part;
};

class Faults : public CliTest, public ::testing::WithParamInterface<Fault> {};

TEST_P(Faults, LoseNothingAtAnyCall) {
    make_shot(4);
    const Words shot = replace({"--threads", "2"});
    expect_success(run(with_options(shot, {"-o", "whole/####.png"})));
    const auto whole = contents("whole");
    const auto [call, kind, part] = GetParam();
    int failed = 0;
    for (int n = 1; n <= 12; ++n) {
        fs::remove_all(folder_ / "out");
        fs::remove_all(folder_ / "home/cache");
        ProcessOptions with = options_;
        with.environment["LD_PRELOAD"] = fault_shim();
        with.environment["WEFT_FAULT"] = call + " " + std::to_string(n) + " " + kind + " " + part;
        const Outcome hit = run_weft(shot, with);
        // A full cache gives a warning: the analysis goes elsewhere.
        const bool full_cache = kind == "ENOSPC" && part == "/cache/";
        const bool harmless = kind == "short" || kind == "slow" || full_cache;
        if (full_cache) {
            EXPECT_THAT(hit.err, ::testing::HasSubstr("cache folder")) << n;
        }
        if (hit.exit != 0) {
            ++failed;
            EXPECT_FALSE(harmless) << hit.err;
            EXPECT_TRUE(hit.exit == 1 || hit.exit == 3 || hit.exit == 6) << hit.exit << hit.err;
            // Libraries may have printed messages before.
            const std::size_t last = hit.err.rfind("weft: ");
            ASSERT_NE(last, std::string::npos) << hit.err;
            expect_one_line(hit.err.substr(last), {});
        }
        for (const auto& [name, hash] : contents("out")) {
            ASSERT_TRUE(whole.contains(name)) << name << " after " << call << " " << n;
            EXPECT_EQ(hash, whole.at(name)) << name << " after " << call << " " << n;
        }
        expect_success(run(with_options(shot, {"--resume"})));
        EXPECT_EQ(contents("out"), whole) << call << " " << n;
    }
    if ((kind == "ENOSPC" || kind == "EIO") && !(kind == "ENOSPC" && part == "/cache/")) {
        EXPECT_GT(failed, 0);
    }
}

INSTANTIATE_TEST_SUITE_P(
    Disk, Faults,
    ::testing::Values(Fault{"write", "ENOSPC", "/out/"}, Fault{"write", "EIO", "/out/"},
                      Fault{"write", "short", "/out/"}, Fault{"write", "slow", "/out/"},
                      Fault{"fsync", "EIO", "/out/"}, Fault{"rename", "EIO", "out/"},
                      Fault{"write", "ENOSPC", "/cache/"}, Fault{"read", "EIO", "/frames/"},
                      Fault{"read", "EIO", "/cache/"}, Fault{"read", "short", "/frames/"}),
    [](const auto& fault) {
        std::string name = fault.param.call + "_" + fault.param.kind + fault.param.part;
        std::replace_if(
            name.begin(), name.end(),
            [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
        return name;
    });

}  // namespace
}  // namespace weft::test
