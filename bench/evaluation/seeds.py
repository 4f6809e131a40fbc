"""Which scenes there are. Half of them are developed on: their seeds are fixed. The other half is reported: its seeds
follow from the commit whose code is reported, so that nobody can have seen them before."""
import hashlib

FAMILIES = ("room", "round", "body", "car", "cloth", "walker", "leaves", "behind", "fast", "lamps", "fur", "drawn")
DEVELOP_SEEDS = (1, 2, 3)
MINI = (("room", 11), ("cloth", 12), ("leaves", 13))


def develop():
    return [(family, seed) for family in FAMILIES for seed in DEVELOP_SEEDS]


def report(commit, each=3):
    """`commit`: the full hash. `each` seeds a family."""
    return [(family, seed_of(commit, family, k)) for family in FAMILIES for k in range(each)]


def seed_of(commit, family, index):
    """1000 and more: no reported scene is one that was developed on."""
    digest = hashlib.sha256(("%s %s %d" % (commit, family, index)).encode()).digest()
    return 1000 + int.from_bytes(digest[:4], "big") % 1000000
