#pragma once
// A process that another one may have started, on this or another machine.

#include <sys/types.h>

#include <cstdint>
#include <string>

namespace weft {

/// Known by more than its number, which the system uses again.
struct JobProcess {
    pid_t id = -1;
    std::uint64_t started = 0;  ///< In ticks after the machine's start.
    std::string machine;        ///< Its name, and which of its starts.
    bool operator==(const JobProcess&) const = default;
};

/// kEnded: it waits for its parent to ask for its status. kElsewhere: nothing is known of it, as
/// on another machine.
enum class ProcessState : std::uint8_t { kRuns, kEnded, kGone, kElsewhere };

/// A process of this machine.
[[nodiscard]] JobProcess process_of(pid_t id);
[[nodiscard]] ProcessState state_of(const JobProcess& process);
/// Sends a signal if it is still that process; returns whether it was sent.
bool signal_to(const JobProcess& process, int signal);

}  // namespace weft
