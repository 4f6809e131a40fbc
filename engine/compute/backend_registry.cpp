#include "engine/compute/backend_registry.h"

#include "engine/core/setting.h"

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
        return fail(ErrorCode::kNoBackend,
                    "No backend is available: " + joined(choice.passed_over));
    }
    const auto entry = std::find_if(entries_.begin(), entries_.end(),
                                    [&](const BackendEntry& e) { return e.name == name; });
    if (entry == entries_.end()) {
        return fail(ErrorCode::kUsage, "Unknown backend '" + name + "'.",
                    "Choose auto, " + joined(names()) + ".");
    }
    auto made = entry->make();
    if (!made) {
        std::vector<std::string> usable;
        for (const auto& e : entries_) {
            if (e.name != name && e.make()) usable.push_back(e.name);
        }
        return fail(ErrorCode::kNoBackend,
                    made.error().text() + " Available: " + joined(usable) + ".",
                    "Choose one of these or auto" + by({{setting::kBackend}}) + ".");
    }
    choice.backend = *made;
    return choice;
}

}  // namespace weft
