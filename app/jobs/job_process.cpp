#include "app/jobs/job_process.h"

#include <signal.h>
#include <unistd.h>

#include <array>
#include <optional>
#include <sstream>

#include "engine/core/input_file.h"

namespace weft {
namespace {

// Files of /proc have no size.
std::string text_of(const std::string& path) {
    const auto file = InputFile::open(path);
    if (!file) return {};
    std::string text(4096, '\0');
    text.resize(file->read_at(0, text.data(), text.size()).value_or(0));
    return text;
}

std::string host_name() {
    std::array<char, 256> name{};
    return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

const std::string& this_machine() {
    static const std::string kMachine = [] {
        std::string boot = text_of("/proc/sys/kernel/random/boot_id");
        while (!boot.empty() && boot.back() == '\n')
            boot.pop_back();
        return host_name() + " " + boot;
    }();
    return kMachine;
}

struct Stat {
    char state = 'R';
    std::uint64_t started = 0;
};

// proc(5): the name, in brackets, may hold anything; the state follows it, and the start is field
// 22 of all.
std::optional<Stat> stat_of(pid_t id) {
    const std::string text = text_of("/proc/" + std::to_string(id) + "/stat");
    const std::size_t name_end = text.rfind(')');
    if (name_end == std::string::npos) return std::nullopt;
    std::istringstream fields(text.substr(name_end + 1));
    Stat out;
    fields >> out.state;
    std::string skipped;
    constexpr int kBetween = 18;  // fields 4 to 21
    for (int k = 0; k < kBetween; ++k)
        fields >> skipped;
    fields >> out.started;
    if (!fields) return std::nullopt;
    return out;
}

}  // namespace

JobProcess process_of(pid_t id) {
    const auto stat = stat_of(id);
    return {id, stat ? stat->started : 0, this_machine()};
}

ProcessState state_of(const JobProcess& process) {
    if (process.id <= 0) return ProcessState::kGone;
    if (process.machine != this_machine()) {
        // The same machine after a new start has none of the processes of before.
        const std::string host = host_name() + " ";
        return process.machine.starts_with(host) ? ProcessState::kGone : ProcessState::kElsewhere;
    }
    const auto stat = stat_of(process.id);
    if (!stat || stat->started != process.started) return ProcessState::kGone;
    return stat->state == 'Z' || stat->state == 'X' ? ProcessState::kEnded : ProcessState::kRuns;
}

bool signal_to(const JobProcess& process, int signal) {
    return state_of(process) == ProcessState::kRuns && ::kill(process.id, signal) == 0;
}

}  // namespace weft
