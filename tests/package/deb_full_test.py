#!/usr/bin/env python3
# The .deb installs on a clean Debian 12 and runs there: debootstrap makes a chroot, apt installs the package with what it
# depends on, and a frame of the demo shot has the bytes of the frame that the build's own program makes. Skips aloud without
# root, debootstrap or a mirror. usage: deb_full_test.py BUILD SOURCE [CHROOT that is there already]
import glob
import os
import shutil
import subprocess
import sys
import tempfile

SKIP = 77
MIRROR = os.environ.get("WEFT_DEBIAN_MIRROR", "http://deb.debian.org/debian")
EXPECTED = ["usr/share/applications/io.weft.Weft.desktop", "usr/share/icons/hicolor/scalable/apps/io.weft.Weft.svg",
            "usr/share/mime/packages/weft.xml", "usr/share/metainfo/io.weft.Weft.metainfo.xml", "usr/share/man/man1/weft.1",
            "usr/share/bash-completion/completions/weft", "usr/share/doc/weft/copyright", "usr/lib/python3/dist-packages/weft/__init__.py",
            "usr/lib/python3/dist-packages/weft/py.typed", "usr/share/weft/blender/weft_blender/__init__.py"]


def skip(why):
    print("SKIPPED:", why)
    sys.exit(SKIP)


def inside(chroot, command):
    """Runs a shell command in the chroot, with /proc; the mount ends with the command."""
    script = 'mount -t proc proc "$0/proc" && exec chroot "$0" sh -c "$1"'
    done = subprocess.run(["unshare", "--mount", "sh", "-c", script, chroot, command], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True)
    print(f"$ {command}\n{done.stdout[-2000:]}", flush=True)
    assert done.returncode == 0, (command, done.returncode)
    return done.stdout


def main():
    build, source = map(os.path.abspath, sys.argv[1:3])
    if os.geteuid() != 0:
        skip("a chroot wants root")
    for tool in ("debootstrap", "cpack", "chroot", "unshare"):
        if not shutil.which(tool):
            skip(f"there is no {tool}")
    if subprocess.run(["unshare", "--mount", "true"], stderr=subprocess.DEVNULL).returncode:
        skip("this machine lets nobody mount")
    folder = tempfile.mkdtemp(prefix="weft_deb_")
    try:
        subprocess.run(["cpack", "-G", "DEB", "-B", folder + "/package"], cwd=build, check=True, stdout=subprocess.DEVNULL)
        (deb,) = glob.glob(folder + "/package/*.deb")
        chroot = sys.argv[3] if len(sys.argv) > 3 else folder + "/root"
        if len(sys.argv) <= 3:
            made = subprocess.run(["debootstrap", "--variant=minbase", "bookworm", chroot, MIRROR], stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT, text=True)
            if made.returncode:
                skip("debootstrap fails here: " + made.stdout[-400:])
        shutil.copy(deb, chroot + "/weft.deb")
        shutil.copy("/etc/resolv.conf", chroot + "/etc/resolv.conf")
        inside(chroot, "apt-get update -q && DEBIAN_FRONTEND=noninteractive apt-get install -q -y "
                       "--no-install-recommends /weft.deb")
        for path in EXPECTED:
            assert os.path.exists(f"{chroot}/{path}"), path
        assert "backends: cpu" in inside(chroot, "weft --version")
        inside(chroot, "weft doctor")
        render = "--frames 1001 --quality draft --backend cpu --threads 1 --no-cache --progress none"
        inside(chroot, f"weft render /usr/share/weft/assets/demo/demo.weft {render} -o /out.####.png")
        subprocess.run([build + "/bin/weft", "render", source + "/assets/demo/demo.weft", *render.split(), "-o",
                        folder + "/out.####.png"], check=True)
        with open(chroot + "/out.1001.png", "rb") as there, open(folder + "/out.1001.png", "rb") as here:
            assert there.read() == here.read(), "the installed program renders other bytes"
        print("the package installs on a clean Debian 12 and renders the same bytes")
    finally:
        shutil.rmtree(folder, ignore_errors=True)


main()
