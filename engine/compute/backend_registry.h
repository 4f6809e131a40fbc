#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/compute/backend.h"
#include "engine/core/error.h"

namespace weft {

/// A backend that may or may not be usable on this machine.
struct BackendEntry {
    std::string name;
    int score = 0;  ///< `auto` takes the available backend with the highest score.
    /// Creates it. Error: NoBackend, with the reason why it is not available.
    std::function<Expected<std::shared_ptr<const Backend>>()> make;
};

/// The chosen backend, and one line for each better one that was skipped.
struct BackendChoice {
    std::shared_ptr<const Backend> backend;
    std::vector<std::string> passed_over;
};

/// The backends of a build. Filled once at start (the CPU is always in it), then only read; reading
/// is thread-safe.
class BackendRegistry {
  public:
    BackendRegistry();  ///< Holds "cpu".
    void add(BackendEntry entry);
    /// "auto" or a name. Errors: Usage for an unknown name (the message lists the known ones),
    /// NoBackend if the named one is not available (the message gives the reason and the
    /// alternatives).
    [[nodiscard]] Expected<BackendChoice> choose(const std::string& name) const;
    [[nodiscard]] std::vector<std::string> names() const;

  private:
    std::vector<BackendEntry> entries_;  // best first
};

[[nodiscard]] std::shared_ptr<const Backend> make_cpu_backend();

}  // namespace weft
