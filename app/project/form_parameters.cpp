#include "app/project/form_parameters.h"

#include "app/project/parameter_entry.h"

namespace weft {

namespace {

using R = Region;

std::vector<Parameter<Region>> amount_parameters() {
    using parameter_entry::entry;
    return {
        entry<R, &R::form, &FormParams::roundness>(
            {.group = "form",
             .key = "roundness",
             .flag = "--form-roundness",
             .help = "How far an inflated form comes out of the picture: 1 half as thick as "
                     "wide, 2 as thick",
             .min = 0.05,
             .max = 2}),
        entry<R, &R::form, &FormParams::amount>(
            {.group = "form",
             .key = "amount",
             .flag = "--form-amount",
             .help = "How far the texture follows the form: 0 flat, 1 as found",
             .min = 0,
             .max = 1}),
        entry<R, &R::form, &FormParams::amount_keys>(
            {.group = "form",
             .key = "amount_keys",
             .flag = "--form-amount-keys",
             .help = "Animated amount: FRAME:A, separated by spaces",
             .min = 0,
             .max = 1}),
    };
}

}  // namespace

std::vector<Parameter<Region>> form_parameters() {
    using parameter_entry::entry;
    std::vector<Parameter<Region>> out{
        entry<R, &R::form, &FormParams::position>(
            {.group = "form",
             .key = "position",
             .flag = "--position-pass",
             .help = "Position pass, EXR: the texture follows the form of the surface",
             .is_path = true}),
        entry<R, &R::form, &FormParams::position_layer>(
            {.group = "form",
             .key = "position_layer",
             .flag = "--position-layer",
             .help = "EXR layer of the position pass; default Position, P or P_World"}),
        entry<R, &R::form, &FormParams::normal>(
            {.group = "form",
             .key = "normal",
             .flag = "--normal-pass",
             .help = "Normal pass, EXR or a normal map: the texture follows its form",
             .is_path = true}),
        entry<R, &R::form, &FormParams::normal_layer>(
            {.group = "form",
             .key = "normal_layer",
             .flag = "--normal-layer",
             .help = "EXR layer of the normal pass; default Normal or N"}),
        entry<R, &R::form, &FormParams::normal_space>(
            {.group = "form",
             .key = "normal_space",
             .flag = "--normal-space",
             .help = "Axes of the normal pass; auto: as the file tells"}),
        entry<R, &R::form, &FormParams::source>(
            {.group = "form",
             .key = "source",
             .flag = "--form",
             .help = "What shows the form; auto: a pass, else a shape, else the motion"}),
        entry<R, &R::form, &FormParams::shape>(
            {.group = "form",
             .key = "shape",
             .flag = "--form-shape",
             .help = "Shape over the surface on its reference frame: plane:x,y,x,y,x,y,x,y, "
                     "cylinder:ax,ay,bx,by,ra,rb[,tilt], cone: the same, or ball:x,y,r",
             .max = 1,
             .choices = {"plane", "cylinder", "cone", "ball"}}),
        entry<R, &R::form, &FormParams::strokes>(
            {.group = "form",
             .key = "strokes",
             .flag = "--form-stroke",
             .help = "Lines on the surface: parallel:x,y,x,y,…, a second group at right angles to "
                     "the first; level:x,y,x,y along the rows of the texture; cut:x,y,x,y,… along "
                     "an outline that does not turn away, for inflate; repeatable",
             .max = 16,
             .repeatable = true,
             .choices = {"parallel", "level", "cut"}}),
        entry<R, &R::form, &FormParams::depth_kind>(
            {.group = "form",
             .key = "depth_kind",
             .flag = "--depth-kind",
             .help = "The depth pass: distances along the camera's axis or along the rays"}),
        entry<R, &R::form, &FormParams::fov_deg>(
            {.group = "form",
             .key = "fov_deg",
             .flag = "--fov",
             .help = "Horizontal field of view in degrees, for normals, depth, shapes and motion; "
                     "default from the pass's header, or found",
             .min = 1,
             .max = 175,
             .optional = true}),
    };
    for (const Parameter<Region>& amount : amount_parameters())
        out.push_back(amount);
    return out;
}

}  // namespace weft
