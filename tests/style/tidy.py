"""clang-tidy on the lines of C++ sources that differ from what was landed last (see run)."""

import concurrent.futures
import json
import os
import re
import subprocess
import sys

SOURCES = ("app", "bench", "engine", "gpu", "texture_db", "ui", "tests")


def git(*arguments):
    return subprocess.run(["git", *arguments], check=True, capture_output=True, text=True).stdout


def base_commit():
    given = os.environ.get("WEFT_STYLE_BASE")
    if given:
        return given
    head = git("rev-parse", "HEAD").strip()
    for other in ("origin/main", "main"):
        try:
            base = git("merge-base", other, "HEAD").strip()
        except subprocess.CalledProcessError:
            continue
        if base != head:
            return base
    try:
        return git("rev-parse", "HEAD^").strip()
    except subprocess.CalledProcessError:
        return None


def changed_lines(base):
    """{path: [[first, last], ...]} of what was added or changed, the working tree included."""
    out, path = {}, None
    for line in git("diff", "-U0", "-M", "--diff-filter=ACMR", base, "--", *SOURCES).splitlines():
        if line.startswith("+++ b/"):
            path = line[6:]
        elif line.startswith("@@") and path:
            first, count = re.match(r"@@ [^+]*\+(\d+)(?:,(\d+))? @@", line).groups()
            if count != "0":
                last = int(first) + int(count or 1) - 1
                out.setdefault(path, []).append([int(first), last])
    return out


def plain_commands(tree):
    """A folder with the tree's compile commands less precompiled headers, which are another compiler's."""
    folder = os.path.join(tree, "tidy")
    with open(os.path.join(tree, "compile_commands.json"), encoding="utf-8") as file:
        commands = json.load(file)
    for entry in commands:
        entry["command"] = re.sub(r" -Winvalid-pch| -fpch-preprocess| -include \S+/cmake_pch\.hxx", "", entry["command"])
    os.makedirs(folder, exist_ok=True)
    with open(os.path.join(folder, "compile_commands.json"), "w", encoding="utf-8") as file:
        json.dump(commands, file)
    return folder


def main(tree):
    base = base_commit()
    if base is None:
        print("style: there is no commit to compare with; clang-tidy is skipped")
        return 0
    changed = changed_lines(base)
    with open(os.path.join(tree, "compile_commands.json"), encoding="utf-8") as commands:
        compiled = {os.path.relpath(entry["file"]) for entry in json.load(commands)}
    # Those with the most changed lines first: where the number is bounded, most is seen.
    files = sorted((path for path in changed if path in compiled and path.endswith(".cpp")),
                   key=lambda path: (-sum(b - a + 1 for a, b in changed[path]), path))
    most = int(os.environ.get("WEFT_TIDY_FILES", "12"))
    # A changed header is seen through the sources that include it.
    lines = json.dumps([{"name": path, "lines": spans} for path, spans in changed.items()
                        if path.endswith((".cpp", ".h"))])

    folder = plain_commands(tree)

    def tidy(path):
        return subprocess.run(
            ["clang-tidy-14", "-p", folder, "--quiet", "--warnings-as-errors=*",
             "--line-filter=" + lines, path], capture_output=True, text=True, check=False)

    failed = 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for path, done in zip(files[:most], pool.map(tidy, files[:most])):
            print(f"style: {path}: {'clean' if done.returncode == 0 else 'see below'}", flush=True)
            if done.returncode != 0:
                failed += 1
                print(done.stdout + done.stderr)
    for path in files[most:]:
        print(f"style: {path}: left out, more than {most} files differ from {base[:10]}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
