"""A project file and its regions as objects: a layer over the commands `new`, `region`, `apply`, `render`, `motion`."""
from __future__ import annotations

import json
import os
import tempfile
from typing import Any, Iterator, List, Mapping, Optional, Sequence, Union

from . import _commands
from ._run import Answer, Cancel, Error, PathOrText, ProgressFn, Value, run


class Region:
    """A region of a project, by its name or id. What it says is read from the file each time."""

    def __init__(self, project: "Project", region: Union[int, str]) -> None:
        self.project = project
        self.region = region

    def __repr__(self) -> str:
        return f"Region({self.project.path!r}, {self.region!r})"

    def _listed(self) -> Answer:
        for found in _commands.region_list(self.project.path):
            if self.region in (found["id"], found["name"]):
                return found
        raise Error(2, f"{self.project.path} has no region {self.region!r}.", "usage", "regions")

    @property
    def id(self) -> int:
        return int(self._listed()["id"])

    @property
    def name(self) -> str:
        return str(self._listed()["name"])

    @property
    def settings(self) -> Answer:
        """All of it, as it stands in the project file (docs/FORMATS.md)."""
        number = self.id
        with open(self.project.path, encoding="utf-8") as file:
            regions: List[Answer] = json.load(file)["regions"]
        return next(found for found in regions if found["id"] == number)

    def set(self, **options: Any) -> None:
        """Changes what is given: set(scale=1.5, enabled=False). The options are those of `weft replace`."""
        _commands.region_set(self.project.path, self.region, **options)
        if isinstance(options.get("name"), str) and isinstance(self.region, str):
            self.region = str(options["name"])

    def correct(self, frame: int, pins: Sequence[str] = ()) -> None:
        """Corrects a drifted texture on a frame; a pin is "x,y:x,y". Without pins the correction is removed."""
        _commands.region_correct(self.project.path, self.region, frame, pin=list(pins))

    def remove(self) -> None:
        """Removes it from the project; the files that it names stay."""
        _commands.region_remove(self.project.path, self.region)


class Project:
    """A project file (`.weft`). Nothing is kept here: several programs may change the file at the same time."""

    def __init__(self, path: "Union[str, os.PathLike[str]]") -> None:
        self.path = os.fspath(path)

    @classmethod
    def create(cls, path: "Union[str, os.PathLike[str]]", plate: PathOrText, **options: Any) -> "Project":
        """A new file; the options are those of `weft new`: output=, frames=, plate_layer= …"""
        _commands.new(path, plate=plate, **options)
        return cls(path)

    def __repr__(self) -> str:
        return f"Project({self.path!r})"

    @property
    def info(self) -> Answer:
        """Plate, frames, spaces, output, regions and warnings; opens the shot."""
        return _commands.info(self.path)

    def issues(self, files: bool = True) -> List[Answer]:
        """What is wrong with it, errors included, and with `files` whether what it names is there; empty: nothing."""
        try:
            return _commands.validate(self.path, no_files=None if files else True)
        except Error as error:
            if "issues" in error.answer:
                return list(error.answer["issues"])
            return [{"severity": "error", "field": error.field, "message": error.message, "remedy": error.remedy}]

    @property
    def regions(self) -> List[Region]:
        """Lowest layer first."""
        return [Region(self, found["id"]) for found in _commands.region_list(self.path)]

    def __iter__(self) -> Iterator[Region]:
        return iter(self.regions)

    def region(self, region: Union[int, str]) -> Region:
        """By name or id. Raises Error if there is none."""
        found = Region(self, region)
        found._listed()
        return found

    def add_region(self, name: str, matte: Value, texture: Optional[PathOrText] = None, **options: Any) -> Region:
        """Adds one on top. texture: a sample, or "db:ID" of the library; plane= a picture as the texture itself."""
        _commands.region_add(self.path, name=name, matte=matte, texture=texture, **options)
        return Region(self, name)

    def apply(self, actions: Sequence[Mapping[str, Any]], dry_run: bool = False) -> Answer:
        """Applies actions (docs/FORMATS.md), all or none."""
        with tempfile.NamedTemporaryFile("w", suffix=".json", encoding="utf-8") as file:
            json.dump({"schema": "weft.actions/1", "actions": list(actions)}, file)
            file.flush()
            return _commands.apply(self.path, file.name, dry_run=dry_run or None)

    def render(self, output: Optional[PathOrText] = None, progress: Optional[ProgressFn] = None,
               cancel: Optional[Cancel] = None, **options: Any) -> Answer:
        """Renders it and returns the report (docs/FORMATS.md). output: instead of the project's own."""
        return run("render", self.path, progress=progress, cancel=cancel, output=output, **options)

    def estimate(self, output: Optional[PathOrText] = None, **options: Any) -> Answer:
        """What a render would do, with time, memory and disk as "estimate"."""
        return run("render", self.path, output=output, dry_run=True, **options)

    def form(self, **options: Any) -> List[Answer]:
        """What form is found for each region."""
        return _commands.form(self.path, **options)

    def motion(self, output: PathOrText, progress: Optional[ProgressFn] = None, cancel: Optional[Cancel] = None,
               **options: Any) -> Answer:
        """Writes the motion of each region for other programs into a folder; returns what motion.json says."""
        return run("motion", self.path, progress=progress, cancel=cancel, output=output, **options)

    def flatten(self, output: Optional[PathOrText] = None, progress: Optional[ProgressFn] = None,
                cancel: Optional[Cancel] = None, **options: Any) -> Answer:
        """Writes a region's surface as one still, unlit picture, or, with back=FILE, takes a painted one back."""
        return run("flatten", self.path, progress=progress, cancel=cancel, output=output, **options)

    def collect(self, folder: PathOrText, **options: Any) -> Answer:
        """Copies all its files into one folder."""
        return _commands.collect(self.path, folder, **options)
