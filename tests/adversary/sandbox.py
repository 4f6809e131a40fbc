"""One case's folder, and the programs that run in it under limits of time and memory."""
import hashlib
import os
import select
import signal
import stat
import subprocess
import time
from dataclasses import dataclass

ADDRESS_SPACE_BYTES = 6 << 30
LARGEST_HASHED_BYTES = 256 << 20  # there are sparse files of gigabytes


@dataclass
class Outcome:
    exit: int  # the negative number of the signal where one ended the program
    out: str
    err: str
    seconds: float
    peak_rss_mb: float
    timed_out: bool


@dataclass(frozen=True)
class Entry:
    """What a path is. Two equal entries are the same file with the same content."""
    kind: int
    mode: int
    content: str


def tree(folder, seen_from):
    """Path -> Entry, for all that is below the folder; the paths are relative to seen_from. Links are not followed."""
    found = {}
    pending = [os.fsencode(folder)]
    while pending:
        for entry in os.scandir(pending.pop()):
            info = entry.stat(follow_symlinks=False)
            kind, content = stat.S_IFMT(info.st_mode), ""
            if kind == stat.S_IFDIR:
                pending.append(entry.path)
            elif kind == stat.S_IFLNK:
                content = os.readlink(entry.path).decode("utf-8", "backslashreplace")
            elif kind == stat.S_IFREG:
                content = f"{info.st_size} bytes of {info.st_mtime_ns}"
                if info.st_size <= LARGEST_HASHED_BYTES:
                    with open(entry.path, "rb") as file:
                        content += hashlib.blake2b(file.read(), digest_size=16).hexdigest()
            name = os.path.relpath(entry.path, os.fsencode(seen_from)).decode("utf-8", "surrogateescape")
            found[name] = Entry(kind, info.st_mode, content)
    return found


class Sandbox:
    """ROOT/shot is the working directory; home, the temporary folder and what the program says lie beside it."""

    def __init__(self, root, weft):
        self.root, self.weft = root, weft
        self.shot = os.path.join(root, "shot")
        for name in ("shot", "home", "tmp", "said"):
            os.makedirs(os.path.join(root, name))
        home = os.path.join(root, "home")
        # No variable of the user reaches the program: the case is the same everywhere.
        self.environment = {"PATH": os.environ.get("PATH", "/usr/bin:/bin"), "HOME": home, "LANG": "C.UTF-8",
                            "TMPDIR": os.path.join(root, "tmp"), "XDG_CACHE_HOME": home + "/cache",
                            "XDG_CONFIG_HOME": home + "/config", "XDG_DATA_HOME": home + "/data",
                            "XDG_STATE_HOME": home + "/state", "XDG_RUNTIME_DIR": home}
        if "LD_LIBRARY_PATH" in os.environ:
            self.environment["LD_LIBRARY_PATH"] = os.environ["LD_LIBRARY_PATH"]

    def tree(self):
        """All that a run may touch and must not: paths are relative to the working directory."""
        return {name: entry for name, entry in tree(self.root, self.shot).items() if not name.startswith("../said")}

    def path(self, name):
        return os.path.join(self.shot, name)

    def put(self, name, data):
        """Writes a file of the shot, with its folders."""
        path = self.path(name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "wb") as file:
            file.write(data.encode() if isinstance(data, str) else data)
        return path

    def get(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()

    def folder(self, name):
        os.makedirs(self.path(name), exist_ok=True)

    def link(self, target, name):
        os.makedirs(os.path.dirname(self.path(name)), exist_ok=True)
        os.symlink(target, self.path(name))

    def tool(self, *words, stdin=None):
        """Runs another program in the shot's folder; its failure is this test's own."""
        done = subprocess.run([str(w) for w in words], cwd=self.shot, stdin=stdin or subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=120)
        if done.returncode != 0:
            raise RuntimeError(f"{words}: {done.stdout.decode(errors='replace')}")
        return done.stdout.decode(errors="replace")

    def run(self, words, seconds=60, stdin="/dev/null", environment=None):
        """Runs Weft."""
        out_path, err_path = os.path.join(self.root, "said/out"), os.path.join(self.root, "said/err")
        command = ["prlimit", f"--as={ADDRESS_SPACE_BYTES}", "--core=0", "--", self.weft, *words]
        begun = time.monotonic()
        with open(stdin, "rb") as source, open(out_path, "wb") as out, open(err_path, "wb") as err:
            child = subprocess.Popen(command, cwd=self.shot, env={**self.environment, **(environment or {})}, stdin=source,
                                     stdout=out, stderr=err, start_new_session=True)
        handle = os.pidfd_open(child.pid)
        timed_out = not select.select([handle], [], [], seconds)[0]
        os.close(handle)
        if timed_out:
            os.killpg(child.pid, signal.SIGKILL)
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)  # Popen must not wait for it again
        texts = []
        for path in (out_path, err_path):
            with open(path, "rb") as file:
                texts.append(file.read(4 << 20).decode("utf-8", "backslashreplace"))
        return Outcome(child.returncode, *texts, time.monotonic() - begun, usage.ru_maxrss / 1024, timed_out)
