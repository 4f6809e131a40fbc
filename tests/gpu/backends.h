#pragma once
// Every implementation that this machine can run.

#include <functional>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "engine/core/isa.h"
#include "gpu/gpu_backend.h"
#include "tests/gpu/emulated_device.h"
#include "tests/gpu/search_cases.h"

namespace weft::test {

/// Opens a search; a null one means that this machine has none, for the reason in `why`.
struct Searcher {
    std::string name;
    std::function<std::unique_ptr<PlaneSearch>(const PlaneSearchSetup&, std::string& why)> open;
    bool gives_costs = true;
};
[[nodiscard]] std::vector<Searcher> searchers();

/// Backends for frames: exact ones give the CPU's bits, the others differ by 1/255 at most.
struct Framer {
    std::string name;
    std::function<std::shared_ptr<const Backend>(std::string& why)> make;
    bool exact = true;
};
[[nodiscard]] std::vector<Framer> framers();

inline std::ostream& operator<<(std::ostream& out, const Searcher& s) {
    return out << s.name;
}
inline std::ostream& operator<<(std::ostream& out, const Framer& f) {
    return out << f.name;
}

[[nodiscard]] std::shared_ptr<const Backend> emulated_backend(
    SearchStrategy strategy = SearchStrategy::kTiled, ThreadOrder order = ThreadOrder::kForward);

}  // namespace weft::test
