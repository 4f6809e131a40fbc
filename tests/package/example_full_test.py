#!/usr/bin/env python3
# find_package(weft) finds what cmake --install has put elsewhere; the example program is built against that alone and renders
# a frame. usage: example_full_test.py BUILD SOURCE
import json
import os
import shutil
import subprocess
import sys
import tempfile


def main():
    build, source = map(os.path.abspath, sys.argv[1:3])
    folder = tempfile.mkdtemp(prefix="weft_example_")
    try:
        prefix = folder + "/prefix"
        subprocess.run(["cmake", "--install", build, "--prefix", prefix], check=True, stdout=subprocess.DEVNULL)
        shutil.copytree(source + "/packaging/example", folder + "/example")
        subprocess.run(["cmake", "-S", folder + "/example", "-B", folder + "/build", "-G", "Ninja",
                        "-DCMAKE_PREFIX_PATH=" + prefix], check=True, stdout=subprocess.DEVNULL)
        subprocess.run(["cmake", "--build", folder + "/build"], check=True)
        demo, out = prefix + "/share/weft/assets/demo", folder + "/out"
        with open(demo + "/demo.weft") as file:
            shot = json.load(file)
        shot["regions"] = shot["regions"][:1]
        shot["settings"] = {"frames": "1001-1002", "quality": "draft"}
        with open(demo + "/short.weft", "w") as file:
            json.dump(shot, file)
        env = dict(os.environ, WEFT=prefix + "/bin/weft", XDG_CACHE_HOME=folder + "/cache")
        subprocess.run([folder + "/build/replace", demo + "/short.weft", demo + "/textures/knit.png", out + "/####.png"],
                       check=True, env=env, stdout=subprocess.DEVNULL)
        assert sorted(os.listdir(out)) == ["1001.png", "1002.png"], os.listdir(out)
        # The Python module runs the installed program.
        code = ("import sys; sys.path.insert(0, sys.argv[1]); import weft; "
                "report = weft.render(sys.argv[2], output=sys.argv[3]); print(len(report['frames']))")
        told = subprocess.run([sys.executable, "-c", code, prefix + "/lib/python3/dist-packages", demo + "/short.weft",
                               folder + "/by_python/####.png"], check=True, stdout=subprocess.PIPE, text=True, env=env).stdout
        assert told.strip() == "2", told
        print("the example is built against the installed libraries and renders")
    finally:
        shutil.rmtree(folder, ignore_errors=True)


main()
