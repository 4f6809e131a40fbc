"""Weft from Python: a thin layer over the command line, typed and without dependencies.

    import weft
    shot = weft.Project.create("shot.weft", plate="frames/####.png")
    shot.add_region("wall", matte="masks/####.png", texture="wool.jpg", scale=1.5)
    report = shot.render("out/####.png", progress=lambda step: print(step.stage, step.frame))
    print(report["fps"], report["warnings"])

Project, Region and Library are objects for what pipelines do most. Every command of the program is a function besides:
`weft region add` is region_add(), `weft texture import` is texture_import(). Keyword arguments are the command's
options (docs/CLI.md) with _ for -. What each value becomes:

    None            the option is omitted
    True, False     --align and --align=false
    a number, string or Path   --scale=1.5
    a list or tuple  the option once per element: matte=["12=a.png", "40=b.png"]

Each function returns the object that the command prints with --json, as a dictionary whose paths are absolute, and
raises Error when the command fails. Every function also takes progress=, called with a Progress for each finished step,
and cancel=, a Cancel that stops it from another thread. The program is the one named by the environment variable WEFT,
else `weft` on the PATH.
"""
from ._commands import (apply, bench, collect, cryptomatte, demo, diff, doctor, edit, flatten, form, info, look_apply,
                        look_save, matte, measure, motion, new, region_add, region_correct, region_list, region_remove, region_set,
                        render, replace, schema, study, submit, synth, task, texture_build, texture_evaluate,
                        texture_export, texture_import, texture_info, texture_kept, texture_list, texture_mark,
                        texture_model, texture_recommend, texture_search, texture_similar, texture_stats, texture_train,
                        texture_verify, trust, validate, verify, version)
from ._library import Library
from ._project import Project, Region
from ._run import Answer, Cancel, Cancelled, Error, Progress, ProgressFn, Value, program, run

__all__ = ["Answer", "Cancel", "Cancelled", "Error", "Library", "Progress", "ProgressFn", "Project", "Region", "Value",
           "program", "run", "version", "replace", "render", "flatten", "form", "motion", "matte", "synth", "bench", "measure",
           "study", "diff", "verify", "cryptomatte", "demo", "new", "region_add", "region_set", "region_remove",
           "region_correct", "region_list", "apply", "info", "validate", "look_save", "look_apply", "collect", "submit",
           "task", "trust", "doctor", "schema", "texture_build", "texture_import", "texture_search", "texture_list",
           "texture_similar", "texture_recommend", "texture_info", "texture_stats", "texture_verify", "texture_train",
           "texture_model", "texture_evaluate", "texture_export", "texture_mark", "texture_kept", "edit"]
