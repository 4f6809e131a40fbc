#!/usr/bin/env python3
"""Exports a project's motion and measures a render: motion_and_measure.py PROJECT RENDER MATTE FOLDER"""
import sys

import weft


def main(project: str, render: str, matte: str, folder: str) -> None:
    shot = weft.Project(project)
    plate = shot.info["plate"]["path"]
    exported = shot.motion(folder, export="corners,st", overwrite=True)
    for region in exported["regions"]:
        pin = region.get("corner_pin")
        print(region["name"], "moves as a plane" if pin else "moves as no plane does")
    measured = weft.measure(plate=plate, result=render, matte=matte)
    print(f"flicker {measured['tde']['mean']:.3f}, of the plate {measured['source_tde']['mean']:.3f}")


if __name__ == "__main__":
    main(*sys.argv[1:])
