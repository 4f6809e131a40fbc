"""Measures one scene: every surface that is replaced, by motion, light, matte, form and the tiled rendering."""
import json
import shutil
import traceback
from pathlib import Path

import figure
from drawn import DrawnSurface
from film import FilmSurface
from rendered import RenderedSurface
from runs import RunFailed, Runs

VERSION = 4  # of the measures: a surface measured by another one is measured again


def surface_folder(work, scene, name):
    """Where a surface's pictures stay: delivered/, light-final/, matte/."""
    return Path(work) / scene.name / name.replace("/", "_")


def measure_scene(scene, weft, work, only=None):
    """{name, family, seed, verified, surfaces, failures}; `only`: the names of the surfaces to measure."""
    surfaces = [p for p in measured_of(scene) if only is None or p["name"] in only]
    found = {"name": scene.name, "family": scene.facts["family"], "seed": scene.facts["seed"],
             "verified": verified(scene), "surfaces": [], "failures": []}
    for part in surfaces:
        folder = surface_folder(work, scene, part["name"])
        shutil.rmtree(folder, ignore_errors=True)
        try:
            record, failures = measure_surface(kind_of(scene, part)(scene, part, Runs(weft, folder)))
        except Exception as error:
            record, failures = {"name": part["name"]}, [failure("truth", error)]
        found["surfaces"].append(record)
        found["failures"] += [{"surface": part["name"], **f} for f in failures]
    found["failures"] = without_folders(found["failures"], {str(weft): "weft", str(work): "WORK",
                                                            str(scene.folder.parent): "CORPUS"})
    return found


def measured_of(scene):
    """What is measured of a scene: its surfaces, and its body as one."""
    return scene.surfaces + figure.of_scene(scene)


def without_folders(failures, names):
    """The same with short names in place of this machine's folders, which are nobody else's."""
    text = json.dumps(failures)
    for folder in sorted(names, key=len, reverse=True):
        text = text.replace(json.dumps(folder)[1:-1], names[folder])
    return json.loads(text)


def kind_of(scene, part):
    if "parts" in part:
        return figure.FigureSurface
    if scene.facts.get("film"):
        return FilmSurface
    return DrawnSurface if scene.drawn else RenderedSurface


def verified(scene):
    """Whether every check of the scene holds; None before it was checked."""
    path = scene.folder / "verified.json"
    return json.loads(path.read_text(encoding="utf-8"))["holds"] if path.is_file() else None


def measure_surface(surface):
    """(the surface's record, failures). Each measure is a method of the same name."""
    record, failures = {"name": surface.name}, []
    for measure in surface.measures:
        for variant in surface.measures[measure]:
            try:
                figures = getattr(surface, measure)(variant) if variant else getattr(surface, measure)()
            except RunFailed as error:
                failures.append({"measure": measure, **error.record})
            except Exception as error:
                failures.append(failure(measure, error))
            else:
                if variant:
                    record.setdefault(measure, {})[variant] = figures
                elif figures is not None:
                    record[measure] = figures
    record["seconds"] = surface.runs.seconds
    surface.tidy()
    return record, failures


def failure(measure, error):
    """Of a measure itself: where it stopped, and why."""
    steps = ["%s:%d, %s" % (Path(s.filename).name, s.lineno, s.name) for s in traceback.extract_tb(error.__traceback__)]
    return {"measure": measure, "command": None, "exit_code": None,
            "stderr": steps[-3:] + ["%s: %s" % (type(error).__name__, error)]}
