#pragma once
#include <string>

#include "app/session/document/document.h"

namespace weft {

/// Where the document's painted mattes are: beside the project, or with the unsaved ones. For one
/// thread.
class MatteFolder {
  public:
    /// The document must stay.
    MatteFolder(const Document& document, std::string state_folder)
        : document_(document), state_folder_(std::move(state_folder)) {}

    /// A file that is not there yet. Each version of a matte has a new name, so that undo finds the
    /// older file.
    [[nodiscard]] std::string new_path(RegionId region, int frame);
    /// As the project names a file.
    [[nodiscard]] std::string beside_project(const std::string& path) const;

  private:
    const Document& document_;
    const std::string state_folder_;
    int serial_ = 0;
};

}  // namespace weft
