#pragma once
// Commands: menus, shortcuts, tooltips, the command palette and the list of shortcuts are all made
// from one table (command_table.h).

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "ui/input/keys.h"

namespace weft {

struct Ctx;

struct Command {
    std::string id;        ///< "view.fit": stable, stored in the settings file.
    std::string category;  ///< "View"
    std::string name;      ///< "Fit to window"
    const char* icon = "";
    std::string default_key;
    bool repeats = false;
    std::function<void(Ctx&)> run;
    std::function<bool(const Ctx&)> enabled;  ///< Null: always.
    std::function<bool(const Ctx&)> checked;  ///< Null: not checkable.
    KeyChord key;
};

class Commands {
  public:
    explicit Commands(std::vector<Command> commands);
    [[nodiscard]] const std::vector<Command>& all() const { return commands_; }
    [[nodiscard]] const Command* find(std::string_view id) const;
    /// Key of a command, such as "Ctrl+S"; empty: none.
    [[nodiscard]] std::string key_of(std::string_view id) const;
    /// Sets the keys: defaults, overridden by the settings. Invalid entries keep the default.
    void bind(const std::map<std::string, std::string>& changed);
    /// Duplicate shortcuts within a context, as "Save and Fit to window: Ctrl+S".
    [[nodiscard]] std::vector<std::string> collisions() const;
    /// Runs the commands of the pressed keys, except while text is being typed.
    void dispatch(Ctx& ctx) const;
    void run(std::string_view id, Ctx& ctx) const;

  private:
    std::vector<Command> commands_;
};

}  // namespace weft
