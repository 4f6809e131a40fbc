#pragma once
#include <vector>

#include "engine/form/form_guide.h"
#include "engine/form/form_map.h"

namespace weft {

/// Turns a surface that is laid flat about `centre`, a place of the reference frame, so that the
/// strokes of kind kLevel run along its rows: by at most a quarter turn, to the mean of their
/// directions, each by its length there. Others of `strokes` do not count.
void turn_level(FormMap& form, const std::vector<FormGuide>& strokes, Vec2 centre);

/// Turns it so that a row or a column runs along `direction` there, a direction of the picture: by
/// at most an eighth of a turn.
void turn_square(FormMap& form, Vec2 centre, Vec2 direction);

}  // namespace weft
