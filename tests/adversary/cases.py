"""The list of cases. Each is a function that makes files in a shot and yields the runs to be judged."""
from dataclasses import dataclass
from typing import Callable

from oracle import Output
from shot import numbered

EVERY = []
# The cases of the plain suite: some of each class, below half a minute.
PLAIN = frozenset("""
    actions/password damage/exr_piz_head dpx/10_big_log exr/deep existing/links existing/look existing/resume_picture
    frames/bad_1-2000000000 jpeg/orientation6 json/region_add_twice json/region_remove json/validate layers/png_alone
    matte/empty_at_first matte/wrong_size movie/ffv1.mkv movie/sound_alone.mp4 name/no_utf8 number/gap number/last
    onto/report_plate onto/self_synth option/scale_nan output/recipe_in_new_folder parts/beauty_depth_exr
    parts/depth_beauty_png pattern/plate_percent_n png/palette4_interlaced png/text_of_escapes project/mutated0
    project/names_twice size/1x1_exr special/actions_fifo special/plate_frame_fifo special/recipe_zero
    special/texture_sparse special/track_zero special/unused_frames texture/plane_missing track/escapes
    usage/verify_json_missing_file windows/negative_exr""".split())


@dataclass
class Case:
    """name: CLASS/WHAT. build(shot) is a generator of Steps; step.outcome is set when it is resumed."""
    name: str
    build: Callable


def add(name, build):
    EVERY.append(Case(name, build))


def case(name):
    """Decorator of a single case."""
    def register(build):
        add(name, build)
        return build
    return register


def frames(shot, pattern="out/{}.png", picture=True, **more):
    """Every frame of the shot as a promised file; picture: with the plate's colours outside of the matte."""
    return [Output(pattern.replace("{}", numbered(frame)), size=shot.size, channels=3,
                   picture=shot.plate(index) if picture else None, **more) for index, frame in enumerate(shot.numbers)]
