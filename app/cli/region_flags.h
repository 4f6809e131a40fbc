#pragma once
// Command-line flags generated from the parameter tables (app/project/parameters.h).

#include <CLI/CLI.hpp>
#include <list>
#include <string>
#include <vector>

#include "app/project/parameters.h"
#include "app/project/project.h"

namespace weft {

/// The flags of one subcommand for project and region parameters, and their given values.
class ProjectFlags {
  public:
    /// Selects the flags of a subcommand.
    struct Which {
        bool plate = true, output = true, render = true, matte = true, region = true;
    };
    ProjectFlags(CLI::App& command, const Which& which);

    /// Applies the given flags. Errors: Usage.
    [[nodiscard]] Status apply(Project& project) const;
    [[nodiscard]] Status apply(Region& region) const;
    /// Returns true if the flag of a project's parameter was given, by Parameter::full_key().
    [[nodiscard]] bool given(std::string_view key) const;
    /// Returns true if a flag of a region was given: matte, placement, form and the like.
    [[nodiscard]] bool gives_region() const;
    /// Builds a project of one region from the flags alone; paths as given.
    [[nodiscard]] Expected<Project> project() const;

  private:
    template <class Owner>
    struct Given {
        const Parameter<Owner>* parameter;
        std::vector<std::string> texts;
        bool flag = false;  ///< --flag, or --flag=false
        const CLI::Option* option = nullptr;
        [[nodiscard]] bool is_given() const {
            return !texts.empty() || (option && option->count() > 0);
        }
    };
    template <class Owner>
    void add(CLI::App& command, const Parameter<Owner>& parameter, std::list<Given<Owner>>& into);

    std::list<Given<Project>> project_;  // a list: CLI11 keeps pointers to the entries
    std::list<Given<Region>> region_;
    std::vector<std::string> mattes_, confirmed_, holdouts_, zones_;
    std::string crypto_files_;
};

}  // namespace weft
