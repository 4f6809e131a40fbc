"""Markdown tables of a results file: by family, and the worst surfaces of each measure."""
from pathlib import Path

import numpy as np

from layout import FIGURE

BEGIN, END = "<!-- corpus:begin -->", "<!-- corpus:end -->"
WORST = 10


class Column:
    """`path`: measure, [variant,] figure. `better`: "less" or "more", or "one" where 1 is right. `scale`: as shown."""

    def __init__(self, title, path, decimals, better="less", scale=1):
        self.title, self.path, self.decimals, self.better, self.scale = title, path.split("."), decimals, better, scale

    def value(self, surface):
        found = surface
        for key in self.path:
            found = found.get(key) if isinstance(found, dict) else None
        return found

    def badness(self, value):
        return {"less": value, "more": -value, "one": abs(value - 1)}[self.better]

    def text(self, value):
        return "–" if value is None else "%.*f" % (self.decimals, self.scale * value)


# The first column of each table is the one its worst surfaces are ordered by.
TABLES = {
    "Motion": [Column("drift on the worst frame, median px", "motion.final.drift_worst_median_px", 2),
               Column("drift on the last frame, median px", "motion.final.drift_last_median_px", 2),
               Column("drift on the last frame, 90 % px", "motion.final.drift_last_p90_px", 2),
               Column("drift of what appears later, 90 % px", "motion.final.drift_fresh_p90_px", 2),
               Column("TDE over the floor", "motion.final.tde_over_floor", 2),
               Column("sharpness", "motion.final.sharpness", 2, "one"),
               Column("draft: drift on the worst frame, median px", "motion.draft.drift_worst_median_px", 2)],
    "Points, 256 × 256, query first": [
              Column("average Jaccard", "points.final.average_jaccard", 3, "more"),
              Column("δ average", "points.final.delta_average", 3, "more"),
              Column("occlusion accuracy", "points.final.occlusion_accuracy", 3, "more"),
              Column("draft: average Jaccard", "points.draft.average_jaccard", 3, "more"),
              Column("DIS chain: average Jaccard", "points.dis_chain.average_jaccard", 3, "more"),
              Column("DIS chain: δ average", "points.dis_chain.delta_average", 3, "more"),
              Column("DIS direct: average Jaccard", "points.dis_direct.average_jaccard", 3, "more")],
    "Light": [Column("levels", "light.final.levels", 1), Column("levels, 95 %", "light.final.levels_p95", 1),
              Column("correlation", "light.final.correlation", 2, "more"),
              Column("levels in the soft edge", "light.final.edge_levels", 1),
              Column("draft: levels", "light.draft.levels", 1),
              Column("plate multiplied on: levels", "light.multiply.levels", 1),
              Column("no light: levels", "light.constant.levels", 1),
              Column("true light's deviation, levels", "light.final.true_deviation_levels", 1)],
    "Matte": [Column("IoU", "matte.one.iou", 3, "more"), Column("IoU, worst frame", "matte.one.iou_worst", 3, "more"),
              Column("boundary F", "matte.one.boundary_f", 3, "more"),
              Column("leak %", "matte.one.leak", 2, scale=100),
              Column("leak %, worst frame", "matte.one.leak_worst", 2, scale=100),
              Column("hole %", "matte.one.hole", 2, scale=100),
              Column("hole %, worst frame", "matte.one.hole_worst", 2, scale=100),
              Column("soft edge, levels", "matte.one.edge_levels", 1),
              Column("its change, levels", "matte.one.edge_change_levels", 1),
              Column("chatter px", "matte.one.chatter_px", 2)],
    "Matte, painted loosely or on three frames": [
              Column("loosely: IoU", "matte.loose.iou", 3, "more"),
              Column("IoU, worst frame", "matte.loose.iou_worst", 3, "more"),
              Column("leak %, worst frame", "matte.loose.leak_worst", 2, scale=100),
              Column("hole %, worst frame", "matte.loose.hole_worst", 2, scale=100),
              Column("three: IoU", "matte.three.iou", 3, "more"),
              Column("IoU, worst frame", "matte.three.iou_worst", 3, "more"),
              Column("leak %, worst frame", "matte.three.leak_worst", 2, scale=100),
              Column("hole %, worst frame", "matte.three.hole_worst", 2, scale=100)],
    "Form": [Column("stretch, median", "form.stretch_median", 2), Column("stretch, 90 %", "form.stretch_p90", 2),
             Column("area, median %", "form.area_median", 0), Column("area, 90 %", "form.area_p90", 0),
             Column("rim: stretch, 90 %", "form.rim_stretch_p90", 2),
             Column("grown: stretch, 90 %", "form.grown_stretch_p90", 2)],
    "Tile by exact coordinates": [Column("levels", "tiled.levels", 1), Column("levels, 95 %", "tiled.levels_p95", 1),
                                  Column("levels in the soft edge", "tiled.edge_levels", 1)],
}


def surfaces_of(results):
    """(scene, surface)… of all."""
    return [(scene, surface) for scene in results["scenes"] for surface in scene["surfaces"]]


def family_of(scene, surface):
    """A body measured as one region is a family of its own."""
    return FIGURE if surface["name"] == FIGURE else scene["family"]


def by_family(results, columns):
    """Median and worst over each family's surfaces."""
    families = list(dict.fromkeys(family_of(scene, s) for scene, s in surfaces_of(results)))
    rows = []
    for family in families + ["all"]:
        chosen = [s for scene, s in surfaces_of(results)
                  if family in (family_of(scene, s), "all") and columns[0].value(s) is not None]
        if chosen:
            rows.append([family, str(len(chosen))] + [both(column, chosen) for column in columns])
    return table(["family", "surfaces"] + [c.title for c in columns], rows)


def both(column, surfaces):
    values = [v for v in map(column.value, surfaces) if v is not None]
    if not values:
        return "–"
    return "%s / %s" % (column.text(float(np.median(values))), column.text(max(values, key=column.badness)))


def ordered(results, columns):
    """(scene, surface)…, the worst of the first column first, those that have no value left out."""
    first = columns[0]
    known = [(scene, s) for scene, s in surfaces_of(results) if first.value(s) is not None]
    return sorted(known, key=lambda pair: -first.badness(first.value(pair[1])))


def worst(results, columns):
    rows = [["%s, %s" % (scene["name"], surface["name"])] + [c.text(c.value(surface)) for c in columns]
            for scene, surface in ordered(results, columns)[:WORST]]
    return table(["surface"] + [c.title for c in columns], rows)


def table(titles, rows):
    head = ["| " + " | ".join(titles) + " |", "|---|" + "---:|" * (len(titles) - 1)]
    return "\n".join(head + ["| " + " | ".join(row) + " |" for row in rows])


def markdown(results):
    machine = results["machine"]
    count, failures = len(surfaces_of(results)), [f for s in results["scenes"] for f in s["failures"]]
    of = (count, len(results["scenes"]), results["half"], results["commit"][:10],
          " (with changes)" if results["dirty"] else "", results["weft"], machine["cpu"], machine["cores"],
          machine["system"], results["date"], "No run failed" if not failures else "%d runs failed" % len(failures))
    parts = ["%d surfaces of %d scenes, half *%s*, commit %s%s, %s; %s, %d cores, %s; %s. Each cell: median / worst of "
             "the surfaces. %s." % of]
    unverified = [s["name"] for s in results["scenes"] if s["verified"] is False]
    if unverified:
        parts.append("**A check of the truth fails** on %s (bench/corpus verify)." % ", ".join(unverified))
    for name, columns in TABLES.items():
        if any(columns[0].value(s) is not None for _, s in surfaces_of(results)):
            parts += ["### %s" % name, by_family(results, columns), "The worst:", worst(results, columns)]
    if failures:
        parts += ["### Failed runs", table(["surface", "measure", "last line"], [
            ["%s, %s" % (s["name"], f["surface"]), f["measure"], (f["stderr"] or [""])[-1].replace("|", "\\|")]
            for s in results["scenes"] for f in s["failures"]])]
    return "\n\n".join(parts)


def replace_between(path, text):
    """Puts `text` between the markers in `path`, which has each once."""
    whole = Path(path).read_text(encoding="utf-8")
    if whole.count(BEGIN) != 1 or whole.count(END) != 1 or whole.index(BEGIN) > whole.index(END):
        raise ValueError("%s needs the lines %s and %s once, in this order" % (path, BEGIN, END))
    before, rest = whole.split(BEGIN)
    after = rest.split(END)[1]
    Path(path).write_text(before + BEGIN + "\n" + text + "\n" + END + after, encoding="utf-8")
