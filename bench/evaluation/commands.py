"""The command line of bench/corpus."""
import argparse
import json
import re
import subprocess
import sys
import time
from pathlib import Path

import clips
import mini
import rendering
import results
import seeds
import sheets
import tables
import verify
from layout import Scene, corpus_folder
from measure import measure_scene

ROOT = Path(__file__).resolve().parent.parent.parent


def main(arguments):
    options = parser().parse_args(arguments)
    try:
        return options.run(options)
    except (rendering.RenderError, OSError, ValueError, subprocess.CalledProcessError) as failure:
        print("corpus: %s" % failure, file=sys.stderr)
        return 1


def parser():
    top = argparse.ArgumentParser(prog="bench/corpus", description="Weft's corpus of scenes with the truth (docs/CORPUS.md)")
    commands = top.add_subparsers(required=True, metavar="COMMAND")
    for name, run, what in (("list", list_scenes, "list the scenes of a half and whether they are rendered and verified"),
                            ("render", render_scenes, "render what is missing of a half, and verify it"),
                            ("verify", verify_scenes, "check every pass of the rendered scenes against another"),
                            ("measure", measure_scenes, "measure weft on the rendered scenes of the developing half"),
                            ("report", report_scenes, "render and measure the half that nobody has seen")):
        one = commands.add_parser(name, help=what, description=what)
        one.set_defaults(run=run)
        choose(one)
        if name in ("measure", "report"):
            program_and_output(one, name)
        if name == "report":
            one.set_defaults(half="report")
    small = commands.add_parser("mini", help="render the mini corpus and put it into tests/data/corpus")
    small.set_defaults(run=write_mini, half="mini", only="", each=3)
    small.add_argument("--corpus", type=Path, default=corpus_folder(), help="folder of the scenes [%(default)s]")
    film = commands.add_parser("clips", help="measure the film clips of bench/clips.json that lie in a folder")
    film.set_defaults(run=measure_clips, half="clips", commit="HEAD")
    film.add_argument("folder", type=Path)
    program_and_output(film, "clips")
    evidence = commands.add_parser("evidence", help="put the tables of a results.json into docs/EVIDENCE.md")
    evidence.set_defaults(run=write_evidence)
    evidence.add_argument("results", type=Path)
    return top


def program_and_output(command, name):
    command.add_argument("--weft", type=Path, default=built_weft(), help="the program [%(default)s]")
    command.add_argument("-o", "--output", type=Path, default=Path("corpus-" + name),
                         help="folder of results.json, table.md and sheets/ [%(default)s]")


def built_weft():
    """The program that was built last."""
    found = [p for p in (ROOT / "build").glob("*/bin/weft") if p.is_file()]
    return max(found, key=lambda p: p.stat().st_mtime, default=Path("weft"))


def choose(command):
    command.add_argument("--half", choices=("develop", "report", "mini"), default="develop",
                         help="develop: fixed seeds; report: seeds from the commit's hash; mini: small, for tests [develop]")
    command.add_argument("--commit", default="HEAD", help="the commit that is reported [HEAD]")
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
        all_of = seeds.report(full_hash(options.commit), options.each)
    else:
        all_of = [s for s in seeds.develop() if s[1] <= options.each]
    wanted = [w for w in options.only.split(",") if w]
    return [(f, s) for f, s in all_of if not wanted or f in wanted or "%s-%d" % (f, s) in wanted]


def folder_of(options, family, seed):
    return options.corpus / ("%s-%d" % (family, seed))


def full_hash(commit):
    found = subprocess.run(["git", "-C", str(ROOT), "rev-parse", "--verify", "--quiet", commit + "^{commit}"],
                           capture_output=True, text=True, check=False)
    if found.returncode:
        raise ValueError("%s is no commit of this repository" % commit)
    return found.stdout.strip()


def look(options):
    if options.half == "mini":
        return rendering.Look(6, "320x180", 32)
    return rendering.Look(options.frames, options.size, options.samples)


def list_scenes(options):
    for family, seed in chosen(options):
        folder = folder_of(options, family, seed)
        state = "not rendered"
        if (folder / "verified.json").exists():
            checks = failed(folder)
            state = "verified" if not checks else "FAILS " + "; ".join(checks)
        print("%-16s %s" % ("%s-%d" % (family, seed), state))
    return 0


def failed(folder):
    with open(folder / "verified.json", encoding="utf-8") as f:
        return ["%s: %g (%g)" % (c["check"], c["value"], c["limit"]) for c in json.load(f)["checks"] if not c["holds"]]


def render_scenes(options):
    bad = 0
    for family, seed in chosen(options):
        scene, seconds = rendering.render(options.corpus, family, seed, look(options))
        bad += not say_rendered(scene, seconds)
    return 1 if bad else 0


def say_rendered(scene, seconds):
    """Returns whether the scene is verified."""
    checks = failed(scene.folder)
    print("%-16s %6.1f s  %s" % (scene.name, seconds, "verified" if not checks else "FAILS " + "; ".join(checks)),
          flush=True)
    return not checks


def measure_scenes(options):
    there = [folder_of(options, *s) for s in chosen(options)]
    measured(options, [Scene(f) for f in there if (f / "verified.json").exists()])
    return 0


def measure_clips(options):
    """What has no truth is left out, saying so."""
    measured(options, clips.scenes(options.folder, options.output.resolve()))
    return 0


def report_scenes(options):
    """The seeds follow from the commit: the program that is measured must be that commit's, and nothing else."""
    frozen = full_hash(options.commit)
    if frozen == full_hash("HEAD") and results.changed():
        raise ValueError("the working tree differs from its commit, from which the reported scenes follow: commit first")
    if built_from(options.weft) != frozen[:7]:
        raise ValueError("%s was not built from commit %s: build it, or name another with --weft or --commit" % (
            options.weft, frozen[:7]))
    scenes, missing = [], []
    for family, seed in chosen(options):
        try:
            scene, seconds = rendering.render(options.corpus, family, seed, look(options))
            say_rendered(scene, seconds)
            scenes.append(scene)
        except rendering.RenderError as failure:
            missing.append("%s-%d" % (family, seed))
            print("corpus: %s" % failure, file=sys.stderr)
    measured(options, scenes)
    if missing:
        print("corpus: not in the report, since they were not rendered: %s" % ", ".join(missing), file=sys.stderr)
    return 1 if missing else 0


def built_from(weft):
    """The commit that `weft --version` names, shortened to seven digits; None without one."""
    said = subprocess.run([str(weft), "--version"], capture_output=True, text=True, check=True).stdout
    found = re.search(r"\b([0-9a-f]{7,40})\b", said)
    return found.group(1)[:7] if found else None


def measured(options, scenes):
    """Measures what is missing, and writes results.json, table.md and the contact sheets."""
    weft, out = options.weft.resolve(), options.output
    path, work = out / "results.json", (out / "pictures").resolve()
    names = [(s.facts["family"], s.facts["seed"]) for s in scenes]
    found = results.opened(path, weft, options.half, names, full_hash(options.commit))
    for scene in scenes:
        missing = results.to_measure(found, scene)
        if missing:
            started = time.monotonic()
            results.put(found, scene, measure_scene(scene, weft, work, missing))
            results.save(path, found)
            print("%-16s %6.1f s  %s" % (scene.name, time.monotonic() - started, ", ".join(missing)), flush=True)
        sheets.scene_sheet(scene, work, out / "sheets" / (scene.name + ".jpg"))
    results.save(path, found)
    (out / "table.md").write_text(tables.markdown(found) + "\n", encoding="utf-8")
    sheets.worst_sheet(found, {s.name: s for s in scenes}, work, out / "sheets" / "worst.jpg")
    print("%s, table.md and sheets/ are written" % path)


def write_evidence(options):
    """Replaces the corpus's tables in docs/EVIDENCE.md by those of a report."""
    found = json.loads(options.results.read_text(encoding="utf-8"))
    if found["dirty"]:
        raise ValueError("%s was measured with changes that no commit has: measure a commit" % options.results)
    tables.replace_between(ROOT / "docs" / "EVIDENCE.md", tables.markdown(found))
    return 0


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
        folder = folder_of(options, family, seed)
        if not (folder / "scene.json").exists():
            continue
        result = verify.verify(Scene(folder))
        bad += not result["holds"]
        print(result["scene"])
        for check in result["checks"]:
            print("  %-4s %-75s %.6g %s (at most %g)" % ("" if check["holds"] else "FAIL", check["check"], check["value"],
                                                         check["unit"], check["limit"]))
    return 1 if bad else 0
