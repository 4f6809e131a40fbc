"""The command line of bench/corpus."""
import argparse
import subprocess
import sys
from pathlib import Path

import mini
import rendering
import seeds
import verify
from layout import Scene, corpus_folder

ROOT = Path(__file__).resolve().parent.parent.parent


def main(arguments):
    options = parser().parse_args(arguments)
    try:
        return options.run(options)
    except (rendering.RenderError, OSError) as failure:
        print("corpus: %s" % failure, file=sys.stderr)
        return 1


def parser():
    top = argparse.ArgumentParser(prog="bench/corpus", description=__doc__)
    commands = top.add_subparsers(required=True, metavar="COMMAND")
    for name, run, what in (("list", list_scenes, "the scenes of a half and whether they are rendered and verified"),
                            ("render", render_scenes, "render what is missing of a half, and verify it"),
                            ("verify", verify_scenes, "check every pass of the rendered scenes against another")):
        one = commands.add_parser(name, help=what, description=what)
        one.set_defaults(run=run)
        choose(one)
    small = commands.add_parser("mini", help="render the mini corpus and put it into tests/data/corpus")
    small.set_defaults(run=write_mini, half="mini", only="", each=3)
    small.add_argument("--corpus", type=Path, default=corpus_folder(), help="folder of the scenes [%(default)s]")
    return top


def choose(command):
    command.add_argument("--half", choices=("develop", "report", "mini"), default="develop",
                         help="develop: fixed seeds; report: seeds from the commit's hash; mini: small, for tests [develop]")
    command.add_argument("--each", type=int, default=3, help="seeds a family [3]")
    command.add_argument("--only", default="", help="families or scenes, by commas: room,cloth-2 [all]")
    command.add_argument("--corpus", type=Path, default=corpus_folder(), help="folder of the scenes [%(default)s]")
    command.add_argument("--frames", type=int, default=24)
    command.add_argument("--size", default="640x360")
    command.add_argument("--samples", type=int, default=16, help="samples a pixel of the pictures [16]")


def chosen(options):
    """(family, seed)…, those with the first seeds of each family first."""
    if options.half == "mini":
        all_of = list(seeds.MINI)
    elif options.half == "report":
        all_of = seeds.report(commit(), options.each)
    else:
        all_of = [s for s in seeds.develop() if s[1] <= options.each]
    wanted = [w for w in options.only.split(",") if w]
    return [(f, s) for f, s in all_of if not wanted or f in wanted or "%s-%d" % (f, s) in wanted]


def commit():
    return subprocess.run(["git", "-C", str(ROOT), "rev-parse", "HEAD"], capture_output=True, text=True,
                          check=True).stdout.strip()


def look(options):
    if options.half == "mini":
        return rendering.Look(6, "320x180", 32)
    return rendering.Look(options.frames, options.size, options.samples)


def list_scenes(options):
    for family, seed in chosen(options):
        folder = options.corpus / ("%s-%d" % (family, seed))
        state = "not rendered"
        if (folder / "verified.json").exists():
            checks = failed(folder)
            state = "verified" if not checks else "FAILS " + "; ".join(checks)
        print("%-16s %s" % ("%s-%d" % (family, seed), state))
    return 0


def failed(folder):
    import json
    with open(folder / "verified.json", encoding="utf-8") as f:
        return ["%s: %g (%g)" % (c["check"], c["value"], c["limit"]) for c in json.load(f)["checks"] if not c["holds"]]


def render_scenes(options):
    bad = 0
    for family, seed in chosen(options):
        scene, seconds = rendering.render(options.corpus, family, seed, look(options))
        checks = failed(scene.folder)
        bad += bool(checks)
        print("%-16s %6.1f s  %s" % (scene.name, seconds, "verified" if not checks else "FAILS " + "; ".join(checks)),
              flush=True)
    return 1 if bad else 0


def write_mini(options):
    for family, seed in chosen(options):
        scene, _ = rendering.render(options.corpus / "mini", family, seed, look(options))
        if failed(scene.folder):
            raise rendering.RenderError("%s is not verified: %s" % (scene.name, "; ".join(failed(scene.folder))))
        mini.reduce(scene, mini.FOLDER)
    size = mini.size_of(mini.FOLDER)
    print("%s: %.1f MB" % (mini.FOLDER, size / 1e6))
    if size > mini.MOST_BYTES:
        raise rendering.RenderError("the mini corpus may have %.0f MB" % (mini.MOST_BYTES / 1e6))
    return 0


def verify_scenes(options):
    bad = 0
    for family, seed in chosen(options):
        folder = options.corpus / ("%s-%d" % (family, seed))
        if not (folder / "scene.json").exists():
            continue
        result = verify.verify(Scene(folder))
        bad += not result["holds"]
        print(result["scene"])
        for check in result["checks"]:
            print("  %-4s %-75s %.6g %s (at most %g)" % ("" if check["holds"] else "FAIL", check["check"], check["value"],
                                                         check["unit"], check["limit"]))
    return 1 if bad else 0
