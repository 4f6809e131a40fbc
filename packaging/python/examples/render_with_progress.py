#!/usr/bin/env python3
"""Makes a project, renders it and stops it after a time: render_with_progress.py PLATE MATTE TEXTURE OUTPUT [SECONDS]"""
import sys
import threading

import weft


def main(plate: str, matte: str, texture: str, output: str, seconds: str = "3600") -> int:
    shot = weft.Project.create("shot.weft", plate=plate, output=output)
    shot.add_region("surface", matte=matte, texture=texture)
    for issue in shot.issues():
        print(f"{issue['field']}: {issue['message']}", file=sys.stderr)

    cancel = weft.Cancel()
    limit = threading.Timer(float(seconds), cancel.cancel)
    limit.start()
    try:
        report = shot.render(quality="draft", cancel=cancel,
                             progress=lambda step: print(f"{step.stage} {step.frame} {step.fraction:.0%}"))
    except weft.Cancelled:
        print("stopped; render again with resume=True")
        return 1
    finally:
        limit.cancel()
    print(f"{len(report['frames'])} frames, {report['fps']:.1f} a second")
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
