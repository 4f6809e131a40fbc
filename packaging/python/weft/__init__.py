"""Weft from Python: a thin layer over the command line, without dependencies.

    import weft
    report = weft.replace(plate="frames/####.png", matte="masks/####.png", texture="wool.jpg", output="out/####.png")
    print(report["fps"], report["warnings"])

Every command of the program is a function here: `weft region add` is region_add(), `weft texture import` is
texture_import(). Keyword arguments are the command's options with _ for -. What each value becomes:

    None            the option is omitted
    True, False     --align and --align=false
    a number, string or Path   --scale=1.5
    a list or tuple  the option once per element: matte=["12=a.png", "40=b.png"]

Each function returns the object that the command prints with --json (docs/CLI.md), as a dictionary whose paths are
absolute, and raises Error when the command fails. The program is the one named by the environment variable WEFT, else
`weft` on the PATH.
"""
import json
import os
import subprocess

__all__ = ["Error", "run", "version", "replace", "render", "flatten", "form", "motion", "matte", "synth", "bench", "measure", "study",
           "diff", "verify", "cryptomatte", "demo", "new", "region_add", "region_set", "region_remove", "region_correct",
           "region_list", "apply", "info", "validate", "look_save", "look_apply", "collect", "submit", "task",
           "trust", "doctor", "schema", "texture_build", "texture_import", "texture_search", "texture_list", "texture_similar",
           "texture_recommend", "texture_info", "texture_stats", "texture_verify", "texture_train", "texture_model",
           "texture_evaluate", "texture_export", "texture_mark", "texture_kept", "edit"]

DIFFERS = 8


class Error(RuntimeError):
    """A command that failed.

    code: its exit code (docs/CLI.md); name: the code's name, such as "unreadable"; message: one line that says what is
    wrong, where, and what to do; field: the option or project path that the error is about, or None; remedy: what to
    do, or None; answer: the whole object that the command printed.
    """

    def __init__(self, code, message, name=None, field=None, remedy=None, answer=None):
        super().__init__(message)
        self.code, self.message = code, message
        self.name, self.field, self.remedy = name, field, remedy
        self.answer = answer if answer is not None else {}


def _program():
    return os.environ.get("WEFT", "weft")


def _text(value):
    return os.fspath(value) if isinstance(value, os.PathLike) else str(value)


def _options(options):
    """The command line's words for keyword arguments."""
    for name, value in options.items():
        flag = "--" + name.rstrip("_").replace("_", "-")  # an option may have a keyword's name: from_=
        values = value if isinstance(value, (list, tuple)) else [value]
        if name == "corners":  # the one option of several words
            yield flag
            yield from map(_text, values)
            continue
        for one in values:
            if one is None:
                continue
            if one is True:
                yield flag
            elif one is False:
                yield flag + "=false"
            else:
                # In one word, so that a value may begin with a hyphen.
                yield flag + "=" + _text(one)


def run(*words, **options):
    """Runs `weft WORDS… --json` and returns the object that it printed. Raises Error."""
    command = [_program(), *map(_text, words), *_options(options), "--json"]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
    try:
        answer = json.loads(done.stdout)
    except ValueError:
        lines = done.stderr.strip().splitlines()
        raise Error(done.returncode, lines[-1] if lines else f"weft ended with {done.returncode}") from None
    if "error" in answer:
        raise Error(done.returncode, answer["error"]["message"], answer["error"]["name"],
                    answer["error"].get("field"), answer["error"].get("remedy"), answer)
    if done.returncode not in (0, DIFFERS):
        raise Error(done.returncode, f"weft ended with {done.returncode}", answer=answer)
    return answer


def version():
    """The program's version, commit and backends."""
    return run("--version")


def replace(**options):
    """weft replace: replaces a surface's texture in a shot; returns the report."""
    return run("replace", **options)


def render(project, **options):
    """weft render: renders a project; returns the report, or what is estimated with dry_run=True."""
    return run("render", project, **options)


def form(project=None, **options):
    """weft form: the list of what form is found for each region of a project, or of plate= and matte=."""
    return run("form", *([] if project is None else [project]), **options)["forms"]


def flatten(project, output=None, **options):
    """weft flatten: writes a region's surface as one still, unlit picture, or, with back=FILE, takes a painted one back."""
    return run("flatten", project, output=output, **options)


def motion(project, output, **options):
    """weft motion: writes the motion of each region for other programs into a folder; returns what motion.json says."""
    return run("motion", project, output=output, **options)


def matte(**options):
    """weft matte: propagates painted mattes; returns "mattes" with each frame's confidence."""
    return run("matte", **options)


def synth(*samples, **options):
    """weft synth: synthesizes a texture from one sample or several of one material."""
    return run("synth", *samples, **options)


def bench(sample, **options):
    """weft bench: times synthesis."""
    return run("bench", sample, **options)


def measure(**options):
    """weft measure: flicker, sharpness, drift and light of a result."""
    return run("measure", **options)


def study(**options):
    """weft study: compares methods on one clip and writes a report."""
    return run("study", **options)


def diff(a, b, **options):
    """weft diff: compares two sequences, images or movies; "equal" is True if they are equal."""
    return run("diff", a, b, **options)


def verify(recipe, **options):
    """weft verify: True if the frames are verified from their recipe."""
    return run("verify", recipe, **options)["proved"]


def cryptomatte(file, **options):
    """weft cryptomatte: the list of a frame's objects."""
    return run("cryptomatte", file, **options)["objects"]


def demo(**options):
    """weft demo: renders the demo shot; returns the report."""
    return run("demo", **options)


def new(project, **options):
    """weft new: creates a project file."""
    return run("new", project, **options)


def region_add(project, **options):
    """weft region add: adds a region on top; returns it as "region"."""
    return run("region", "add", project, **options)


def region_set(project, region, **options):
    """weft region set: changes a region; returns it as "region"."""
    return run("region", "set", project, region, **options)


def region_remove(project, region):
    """weft region remove: removes a region."""
    return run("region", "remove", project, region)


def region_correct(project, region, frame, **options):
    """weft region correct: corrects a drifted texture on a frame; without pin= the correction is removed."""
    return run("region", "correct", project, region, frame, **options)


def region_list(project):
    """weft region list: the list of regions, lowest layer first."""
    return run("region", "list", project)["regions"]


def apply(project, actions, **options):
    """weft apply: applies a file of actions, all or none."""
    return run("apply", project, actions, **options)


def info(project):
    """weft info: the contents of a project."""
    return run("info", project)


def validate(project, **options):
    """weft validate: the list of "issues" of a project; errors raise Error, whose answer has them all."""
    return run("validate", project, **options)["issues"]


def look_save(project, look, **options):
    """weft look save: writes the look of a project's regions."""
    return run("look", "save", project, look, **options)


def look_apply(look, project, **options):
    """weft look apply: applies a look to a project's regions."""
    return run("look", "apply", look, project, **options)


def collect(project, folder, **options):
    """weft collect: copies all files of a project into one folder."""
    return run("collect", project, folder, **options)


def submit(project, to, output, **options):
    """weft submit: writes a job for a render farm; returns the list of its files. run=True submits it (Slurm)."""
    return run("submit", project, to=to, output=output, **options)["files"]


def task(job, stage, index, **options):
    """weft task: runs one task of a farm job."""
    return run("task", job, stage, index, **options)


def trust(folder=None, **options):
    """weft trust: allows the projects of a folder to write outside of it; list=True returns the trusted folders."""
    return run("trust", *([] if folder is None else [folder]), **options)


def doctor(**options):
    """weft doctor: checks the installation; returns the list of findings."""
    return run("doctor", **options)["findings"]


def schema(name):
    """weft schema: the JSON Schema of "project", "actions", "report" or "error"."""
    return run("schema", name)["json_schema"]


def texture_build(**options):
    """weft texture build: builds the full library from Debian packages."""
    return run("texture", "build", **options)


def texture_import(*paths, **options):
    """weft texture import: adds your own images."""
    return run("texture", "import", *paths, **options)


def texture_search(*words, **options):
    """weft texture search: finds samples by words."""
    return run("texture", "search", *words, **options)


def texture_list(**options):
    """weft texture list: lists samples."""
    return run("texture", "list", **options)


def texture_similar(what, **options):
    """weft texture similar: finds samples similar to a sample or an image."""
    return run("texture", "similar", what, **options)


def texture_recommend(**options):
    """weft texture recommend: suggests textures for regions of a frame."""
    return run("texture", "recommend", **options)


def texture_info(id, **options):
    """weft texture info: everything known about a sample."""
    return run("texture", "info", id, **options)


def texture_stats(**options):
    """weft texture stats: numbers of samples."""
    return run("texture", "stats", **options)


def texture_verify(**options):
    """weft texture verify: checks every sample of the library; "sound" is True if it has no faults."""
    return run("texture", "verify", **options)


def texture_train(**options):
    """weft texture train: trains the descriptor on the library."""
    return run("texture", "train", **options)


def texture_model(*folder, **options):
    """weft texture model: sets the image-text model, or returns the current one."""
    return run("texture", "model", *folder, **options)


def texture_evaluate(*folder, **options):
    """weft texture evaluate: how often the material of an unseen photograph is recognised."""
    return run("texture", "evaluate", *folder, **options)


def texture_export(*ids, **options):
    """weft texture export: writes samples as images, with their credits."""
    return run("texture", "export", *ids, **options)


def texture_mark(*ids, **options):
    """weft texture mark: sets favourites, ratings, collections, materials and tags of samples."""
    return run("texture", "mark", *ids, **options)


def texture_kept(**options):
    """weft texture kept: collections, saved searches and recently used samples."""
    return run("texture", "kept", **options)


def edit(*project, **options):
    """weft edit: opens the editor, or writes a screenshot with screenshot=; returns when it is closed."""
    return run("edit", *project, **options)
