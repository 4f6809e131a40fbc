#include "engine/compute/backend_registry.h"

#include <algorithm>

namespace weft {
namespace {

std::string joined(const std::vector<std::string>& words) {
    std::string out;
    for (const auto& w : words)
        out += (out.empty() ? "" : ", ") + w;
    return out;
}

}  // namespace

BackendRegistry::BackendRegistry() {
    add({"cpu", 0, [] { return Expected<std::shared_ptr<const Backend>>(make_cpu_backend()); }});
}

void BackendRegistry::add(BackendEntry entry) {
    const auto at = std::find_if(entries_.begin(), entries_.end(),
                                 [&](const BackendEntry& e) { return e.score < entry.score; });
    entries_.insert(at, std::move(entry));
}

std::vector<std::string> BackendRegistry::names() const {
    std::vector<std::string> out;
    for (const auto& e : entries_)
        out.push_back(e.name);
    return out;
}

Expected<BackendChoice> BackendRegistry::choose(const std::string& name) const {
    BackendChoice choice;
    if (name == "auto") {
        for (const auto& entry : entries_) {
            auto made = entry.make();
            if (made) {
                choice.backend = *made;
                return choice;
            }
            choice.passed_over.push_back(entry.name + ": " + made.error().text());
        }
        return fail(ErrorCode::kNoBackend, "No backend can be had: " + joined(choice.passed_over));
    }
    const auto entry = std::find_if(entries_.begin(), entries_.end(),
                                    [&](const BackendEntry& e) { return e.name == name; });
    if (entry == entries_.end()) {
        return fail(ErrorCode::kUsage,
                    "There is no backend '" + name + "'. Known are auto, " + joined(names()) + ".");
    }
    auto made = entry->make();
    if (!made) {
        std::vector<std::string> usable;
        for (const auto& e : entries_) {
            if (e.name != name && e.make()) usable.push_back(e.name);
        }
        return fail(ErrorCode::kNoBackend, made.error().text() + " Usable here: " + joined(usable) +
                                               "; --backend auto takes the best of them.");
    }
    choice.backend = *made;
    return choice;
}

}  // namespace weft
