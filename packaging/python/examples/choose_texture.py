#!/usr/bin/env python3
"""Gives every region the texture that suits it best: choose_texture.py PROJECT LIBRARY [WORDS]"""
import sys

import weft


def main(project: str, library: str, words: str = "") -> None:
    shot, textures = weft.Project(project), weft.Library(library)
    if words:
        for found in textures.search(words, count=5):
            print(found["id"], found["name"])
    for suggested in textures.recommend(shot, count=3):
        best = suggested["results"][0]
        print(f"{suggested['region']}: {best['name']}, {'; '.join(best['reasons'])}")
        shot.region(suggested["region"]).set(texture="db:" + best["id"], db=library)


if __name__ == "__main__":
    main(*sys.argv[1:])
