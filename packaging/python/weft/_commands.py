"""Every command of the program as a function (docs/CLI.md): `weft region add` is region_add().

Positional arguments are the command's own; keyword arguments are its options with _ for -, and progress= and cancel=
(see weft.run). Each returns what the command prints with --json, or the part that is named below, and raises
weft.Error.
"""
from __future__ import annotations

from typing import Any, List, Optional, Union, cast

from ._run import Answer, PathOrText, run


def version() -> Answer:
    """The program's version, commit and backends."""
    return run("--version")


def replace(**options: Any) -> Answer:
    """weft replace: replaces a surface's texture in a shot; returns the report."""
    return run("replace", **options)


def render(project: PathOrText, **options: Any) -> Answer:
    """weft render: renders a project; returns the report, or what is estimated with dry_run=True."""
    return run("render", project, **options)


def flatten(project: PathOrText, output: Optional[PathOrText] = None, **options: Any) -> Answer:
    """weft flatten: writes a region's surface as one still, unlit picture, or, with back=FILE, takes a painted one back."""
    return run("flatten", project, output=output, **options)


def form(project: Optional[PathOrText] = None, **options: Any) -> List[Answer]:
    """weft form: the list of what form is found for each region of a project, or of plate= and matte=."""
    return cast("List[Answer]", run("form", *([] if project is None else [project]), **options)["forms"])


def motion(project: PathOrText, output: PathOrText, **options: Any) -> Answer:
    """weft motion: writes the motion of each region for other programs into a folder; returns what motion.json says."""
    return run("motion", project, output=output, **options)


def matte(**options: Any) -> Answer:
    """weft matte: propagates painted mattes; returns "mattes" with each frame's confidence."""
    return run("matte", **options)


def synth(*samples: PathOrText, **options: Any) -> Answer:
    """weft synth: synthesizes a texture from one sample or several of one material."""
    return run("synth", *samples, **options)


def bench(sample: PathOrText, **options: Any) -> Answer:
    """weft bench: times synthesis."""
    return run("bench", sample, **options)


def measure(**options: Any) -> Answer:
    """weft measure: flicker, sharpness, drift and light of a result."""
    return run("measure", **options)


def study(**options: Any) -> Answer:
    """weft study: compares methods on one clip and writes a report."""
    return run("study", **options)


def diff(a: PathOrText, b: PathOrText, **options: Any) -> Answer:
    """weft diff: compares two sequences, images or movies; "equal" is True if they are equal."""
    return run("diff", a, b, **options)


def verify(recipe: PathOrText, **options: Any) -> bool:
    """weft verify: True if the frames are verified from their recipe."""
    return cast("bool", run("verify", recipe, **options)["proved"])


def cryptomatte(file: PathOrText, **options: Any) -> List[Answer]:
    """weft cryptomatte: the list of a frame's objects."""
    return cast("List[Answer]", run("cryptomatte", file, **options)["objects"])


def demo(**options: Any) -> Answer:
    """weft demo: renders the demo shot; returns the report."""
    return run("demo", **options)


def new(project: PathOrText, **options: Any) -> Answer:
    """weft new: creates a project file."""
    return run("new", project, **options)


def region_add(project: PathOrText, **options: Any) -> Answer:
    """weft region add: adds a region on top; returns it as "region"."""
    return run("region", "add", project, **options)


def region_set(project: PathOrText, region: Union[int, str], **options: Any) -> Answer:
    """weft region set: changes a region; returns it as "region"."""
    return run("region", "set", project, region, **options)


def region_remove(project: PathOrText, region: Union[int, str]) -> Answer:
    """weft region remove: removes a region."""
    return run("region", "remove", project, region)


def region_correct(project: PathOrText, region: Union[int, str], frame: Union[int, str], **options: Any) -> Answer:
    """weft region correct: corrects a drifted texture on a frame; without pin= the correction is removed."""
    return run("region", "correct", project, region, frame, **options)


def region_list(project: PathOrText) -> List[Answer]:
    """weft region list: the list of regions, lowest layer first."""
    return cast("List[Answer]", run("region", "list", project)["regions"])


def apply(project: PathOrText, actions: PathOrText, **options: Any) -> Answer:
    """weft apply: applies a file of actions, all or none."""
    return run("apply", project, actions, **options)


def info(project: PathOrText) -> Answer:
    """weft info: the contents of a project."""
    return run("info", project)


def validate(project: PathOrText, **options: Any) -> List[Answer]:
    """weft validate: the list of "issues" of a project; errors raise Error, whose answer has them all."""
    return cast("List[Answer]", run("validate", project, **options)["issues"])


def look_save(project: PathOrText, look: PathOrText, **options: Any) -> Answer:
    """weft look save: writes the look of a project's regions."""
    return run("look", "save", project, look, **options)


def look_apply(look: PathOrText, project: PathOrText, **options: Any) -> Answer:
    """weft look apply: applies a look to a project's regions."""
    return run("look", "apply", look, project, **options)


def collect(project: PathOrText, folder: PathOrText, **options: Any) -> Answer:
    """weft collect: copies all files of a project into one folder."""
    return run("collect", project, folder, **options)


def submit(project: PathOrText, to: PathOrText, output: PathOrText, **options: Any) -> List[str]:
    """weft submit: writes a job for a render farm; returns the list of its files. run=True submits it (Slurm)."""
    return cast("List[str]", run("submit", project, to=to, output=output, **options)["files"])


def task(job: PathOrText, stage: str, index: Union[int, str], **options: Any) -> Answer:
    """weft task: runs one task of a farm job."""
    return run("task", job, stage, index, **options)


def trust(folder: Optional[PathOrText] = None, **options: Any) -> Answer:
    """weft trust: allows the projects of a folder to write outside of it; list=True returns the trusted folders."""
    return run("trust", *([] if folder is None else [folder]), **options)


def doctor(**options: Any) -> List[Answer]:
    """weft doctor: checks the installation; returns the list of findings."""
    return cast("List[Answer]", run("doctor", **options)["findings"])


def schema(name: str) -> Answer:
    """weft schema: the JSON Schema of "project", "actions", "report", "motion" or "error"."""
    return cast("Answer", run("schema", name)["json_schema"])


def texture_build(**options: Any) -> Answer:
    """weft texture build: builds the full library from Debian packages."""
    return run("texture", "build", **options)


def texture_import(*paths: PathOrText, **options: Any) -> Answer:
    """weft texture import: adds your own images."""
    return run("texture", "import", *paths, **options)


def texture_search(*words: PathOrText, **options: Any) -> Answer:
    """weft texture search: finds samples by words."""
    return run("texture", "search", *words, **options)


def texture_list(**options: Any) -> Answer:
    """weft texture list: lists samples."""
    return run("texture", "list", **options)


def texture_similar(what: PathOrText, **options: Any) -> Answer:
    """weft texture similar: finds samples similar to a sample or an image."""
    return run("texture", "similar", what, **options)


def texture_recommend(**options: Any) -> Answer:
    """weft texture recommend: suggests textures for regions of a frame."""
    return run("texture", "recommend", **options)


def texture_info(id: PathOrText, **options: Any) -> Answer:
    """weft texture info: everything known about a sample."""
    return run("texture", "info", id, **options)


def texture_stats(**options: Any) -> Answer:
    """weft texture stats: numbers of samples."""
    return run("texture", "stats", **options)


def texture_verify(**options: Any) -> Answer:
    """weft texture verify: checks every sample of the library; "sound" is True if it has no faults."""
    return run("texture", "verify", **options)


def texture_train(**options: Any) -> Answer:
    """weft texture train: trains the descriptor on the library."""
    return run("texture", "train", **options)


def texture_model(*folder: PathOrText, **options: Any) -> Answer:
    """weft texture model: sets the image-text model, or returns the current one."""
    return run("texture", "model", *folder, **options)


def texture_evaluate(*folder: PathOrText, **options: Any) -> Answer:
    """weft texture evaluate: how often the material of an unseen photograph is recognised."""
    return run("texture", "evaluate", *folder, **options)


def texture_export(*ids: PathOrText, **options: Any) -> Answer:
    """weft texture export: writes samples as images, with their credits."""
    return run("texture", "export", *ids, **options)


def texture_mark(*ids: PathOrText, **options: Any) -> Answer:
    """weft texture mark: sets favourites, ratings, collections, materials and tags of samples."""
    return run("texture", "mark", *ids, **options)


def texture_kept(**options: Any) -> Answer:
    """weft texture kept: collections, saved searches and recently used samples."""
    return run("texture", "kept", **options)


def edit(*project: PathOrText, **options: Any) -> Answer:
    """weft edit: opens the editor, or writes a screenshot with screenshot=; returns when it is closed."""
    return run("edit", *project, **options)
