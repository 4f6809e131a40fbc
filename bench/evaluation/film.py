"""A surface of a film clip: its truth is a mask by frame, and the motion where that is known."""
import mattes
from clips import EDGE_PX
from drawn import DrawnSurface
from rendered import RenderedSurface


class FilmSurface(DrawnSurface):
    """What passes in front of it is cut out of its masks, and nothing is told of soft edges where these are hard."""

    def __init__(self, scene, part, runs):
        RenderedSurface.__init__(self, scene, part, runs)
        self.true_motion = ("--motion", scene.pattern("motion", self.name, ending="png"))
        self.moving = scene.file(1, "motion", self.name, ending="png").is_file()
        followed = {"motion": ("draft", "final")} if self.moving else {}
        self.measures = {"deliver": (None,), **followed, "matte": mattes.PAINTED}

    def deliver(self):
        self.deliver_with()

    def extent(self, frame):
        return self.truth.core(frame, EDGE_PX)
