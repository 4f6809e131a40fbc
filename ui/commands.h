#pragma once
// Everything that can be done by name: menus, shortcuts, tooltips, the palette and the sheet of
// shortcuts all come from this one table.

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "ui/keys.h"

namespace weft {

struct Ctx;

struct Command {
    std::string id;        ///< "view.fit": stable, in the settings file.
    std::string category;  ///< "View"
    std::string name;      ///< "Fit to window"
    const char* icon = "";
    std::string default_key;
    bool repeats = false;
    std::function<void(Ctx&)> run;
    std::function<bool(const Ctx&)> enabled;  ///< Null: always.
    std::function<bool(const Ctx&)> checked;  ///< Null: not a switch.
    KeyChord key;
};

/// The table itself, in the order of the menus; keys are the defaults, not yet read.
[[nodiscard]] std::vector<Command> all_commands();

class Commands {
  public:
    Commands();
    [[nodiscard]] const std::vector<Command>& all() const { return commands_; }
    [[nodiscard]] const Command* find(std::string_view id) const;
    /// "Ctrl+S", or nothing.
    [[nodiscard]] std::string key_of(std::string_view id) const;
    /// The defaults, changed by what the settings say; what cannot be read is left at its default.
    void bind(const std::map<std::string, std::string>& changed);
    /// Commands that share a key within a context, as "Save and Fit the picture: Ctrl+S".
    [[nodiscard]] std::vector<std::string> collisions() const;
    /// Runs what the pressed keys stand for. Nothing happens while a text is being typed.
    void dispatch(Ctx& ctx) const;
    void run(std::string_view id, Ctx& ctx) const;

  private:
    std::vector<Command> commands_;
};

}  // namespace weft
