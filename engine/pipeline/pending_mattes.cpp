#include "engine/pipeline/pending_mattes.h"

#include <cstdlib>
#include <utility>

#include "engine/mask/scene_past.h"
#include "engine/mask/taken_over.h"

namespace weft {

void PendingMattes::complete(int frame, int step, const std::vector<Matte>& late) {
    int then = frame;
    for (const Matte& pieces : late) {
        then -= step;
        for (PendingMatte& pending : mattes_)
            if (pending.frame == then && pending.open) add_pieces(pieces, pending.estimate.matte);
    }
}

std::vector<PendingMatte> PendingMattes::take(int frame, bool last) {
    std::vector<PendingMatte> done;
    while (!mattes_.empty() && (last || std::abs(frame - mattes_.front().frame) >=
                                            static_cast<int>(ScenePast::kFrames))) {
        done.push_back(std::move(mattes_.front()));
        mattes_.pop_front();
    }
    return done;
}

}  // namespace weft
