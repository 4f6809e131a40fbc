"""The texture library: a layer over `weft texture`."""
from __future__ import annotations

import os
from typing import Any, List, Optional, Union, cast

from . import _commands
from ._project import Project
from ._run import Answer, PathOrText


class Library:
    """A texture library; without a path the user's own. A texture's name for projects is "db:" and its id."""

    def __init__(self, path: "Union[None, str, os.PathLike[str]]" = None) -> None:
        self.path = None if path is None else os.fspath(path)

    def __repr__(self) -> str:
        return f"Library({self.path!r})"

    def search(self, words: str, count: int = 20, **options: Any) -> List[Answer]:
        """Samples by words ("rough grey stone"), best first; the options are filters, such as material= or rating=."""
        found = _commands.texture_search(words, db=self.path, count=count, **options)
        return cast("List[Answer]", found["results"])

    def similar(self, what: PathOrText, count: int = 20, **options: Any) -> List[Answer]:
        """Samples that look like a sample (by its id) or a picture, best first."""
        found = _commands.texture_similar(what, db=self.path, count=count, **options)
        return cast("List[Answer]", found["results"])

    def recommend(self, project: Optional[Project] = None, **options: Any) -> List[Answer]:
        """Suggestions for the regions of a project, or for plate= and matte=; an object for each region."""
        path = None if project is None else project.path
        return cast("List[Answer]", _commands.texture_recommend(db=self.path, project=path, **options)["regions"])

    def texture(self, id: PathOrText) -> Answer:
        """Everything known about a sample."""
        return _commands.texture_info(id, db=self.path)

    def add(self, *pictures: PathOrText, **options: Any) -> Answer:
        """Imports pictures or folders of them."""
        return _commands.texture_import(*pictures, db=self.path, **options)
