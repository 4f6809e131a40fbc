#pragma once
// Internal: the Cryptomatte layers of an EXR, and their samples.

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/geometry.h"
#include "engine/media/picture_file.h"

namespace weft {

struct CryptoLayer {
    std::string name;
    int part = 0;
    std::vector<std::array<int, 2>> ranks;  // channels of id and coverage
    std::map<std::string, std::uint32_t> ids;
    std::string stored_as;  // "half, dwaa": what may have changed its ids
};

class CryptoFile {
  public:
    /// Errors: MissingFrames for no such file; Unreadable if it is not an EXR or has no
    /// Cryptomatte.
    [[nodiscard]] static Expected<CryptoFile> open(const std::string& path);

    [[nodiscard]] const std::vector<CryptoLayer>& layers() const { return layers_; }

    /// The display window's samples of a layer's ranks: id, coverage, id, coverage … An id that
    /// PXR24 has rounded is that of the manifest or of `also` again. Errors: Unreadable for a
    /// damaged file, and if the ids have lost more bits than that; NoSpace.
    [[nodiscard]] Expected<std::vector<float>> samples(const CryptoLayer& layer, Size& size,
                                                       const std::set<std::uint32_t>& also = {});

  private:
    std::string path_;
    std::unique_ptr<OIIO::ImageInput> input_;
    std::vector<CryptoLayer> layers_;
};

}  // namespace weft
