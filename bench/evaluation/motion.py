"""Flicker of a followed texture along the true motion, as `weft measure` tells it."""
NAMES = ("tde", "tde_floor", "tde_over_floor", "end_drift_px", "sharpness", "sharpness_least", "true_chatter_px")


def measure(runs, plate, options, result, reference, last):
    """`options`: matte, texture and true motion; `result`: pattern of the frames, without light and grain.

    From the reference frame on, since the ideal that the floor comes from is placed there. true_chatter_px is the floor
    of mattes' chatter: that of the true ones."""
    said = runs("flicker", "measure", "--result", result, "--plate", plate, *options, "--reference-frame", reference,
                "--frames", "%d-%d" % (reference, last))
    sharpness, chatter = said["sharpness_kept"] or {}, said["matte_chatter_px"] or {}
    found = {"tde": (said["tde"] or {}).get("mean"), "tde_floor": (said["tde_floor"] or {}).get("mean"),
             "tde_over_floor": said["tde_over_floor"], "end_drift_px": said["drift_px"],
             "sharpness": sharpness.get("mean"), "sharpness_least": sharpness.get("least"),
             "true_chatter_px": chatter.get("mean")}
    return {k: None if found[k] is None else round(found[k], 4) for k in NAMES}
