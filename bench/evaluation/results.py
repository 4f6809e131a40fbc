"""The file of results (docs/schemas/corpus-results.schema.json), to which every run adds what is not measured yet."""
import datetime
import hashlib
import json
import os
import platform
import subprocess
from pathlib import Path

import jsonschema

from measure import VERSION, measured_of

ROOT = Path(__file__).resolve().parent.parent.parent
SCHEMA_FILE = ROOT / "docs" / "schemas" / "corpus-results.schema.json"
SCHEMA = "weft.corpus-results/1"


def opened(path, weft, half, seeds, commit):
    """The results in `path`, or new ones, with the header of this run. `seeds`: [[family, seed]…]."""
    path = Path(path)
    before = json.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}
    kept = before.get("scenes", []) if before.get("schema") == SCHEMA else []
    wanted = {tuple(s) for s in seeds}
    version = run(str(weft), "--version").splitlines()[0]
    return {"schema": SCHEMA, "version": VERSION, "commit": commit,
            "dirty": changed(),
            "machine": machine(), "date": datetime.datetime.now(datetime.timezone.utc).date().isoformat(), "half": half,
            "seeds": [list(s) for s in seeds], "weft": version, "weft_sha256": digest(weft),
            "scenes": [s for s in kept if (s["family"], s["seed"]) in wanted]}


def changed():
    """Whether the working tree has changes that no commit has."""
    return bool(run("git", "-C", str(ROOT), "status", "--porcelain", "--untracked-files=no"))


def run(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()


def digest(path):
    return hashlib.sha256(Path(path).read_bytes()).hexdigest()


def machine():
    """CPU model, cores that may be used, memory in GiB, and the operating system."""
    cpu = next((line.split(":", 1)[1].strip() for line in lines("/proc/cpuinfo") if line.startswith("model name")),
               platform.machine())
    memory = next((int(line.split()[1]) for line in lines("/proc/meminfo") if line.startswith("MemTotal")), 0)
    system = next((line.split("=", 1)[1].strip().strip('"') for line in lines("/etc/os-release")
                   if line.startswith("PRETTY_NAME=")), platform.system())
    return {"cpu": cpu, "cores": len(os.sched_getaffinity(0)), "memory_gib": round(memory / 2 ** 20, 1),
            "system": system}


def lines(path):
    try:
        return Path(path).read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError:
        return []


def stamp(results, scene):
    """What a surface's figures depend on."""
    facts = hashlib.sha256(json.dumps(scene.facts, sort_keys=True).encode()).hexdigest()
    return {"weft_sha256": results["weft_sha256"], "scene_sha256": facts, "version": VERSION}


def to_measure(results, scene):
    """The names of the scene's surfaces that were not measured by this program, on this scene, without a failure."""
    now, found = stamp(results, scene), record_of(results, scene.name)
    failed = {f["surface"] for f in found["failures"]} if found else set()
    done = {s["name"] for s in found["surfaces"] if s["of"] == now} - failed if found else set()
    return [p["name"] for p in measured_of(scene) if p["name"] not in done]


def record_of(results, name):
    return next((s for s in results["scenes"] if s["name"] == name), None)


def put(results, scene, measured):
    """Adds what measure_scene returned; surfaces that it did not measure stay."""
    now, before = stamp(results, scene), record_of(results, scene.name)
    fresh = {s["name"] for s in measured["surfaces"]}
    there = {p["name"] for p in measured_of(scene)}
    surfaces = [{**s, "of": now} for s in measured["surfaces"]]
    failures = list(measured["failures"])
    if before:
        surfaces += [s for s in before["surfaces"] if s["name"] in there - fresh]
        failures += [f for f in before["failures"] if f["surface"] in there - fresh]
        results["scenes"].remove(before)
    order = [p["name"] for p in measured_of(scene)]
    surfaces.sort(key=lambda s: order.index(s["name"]))
    results["scenes"].append({**measured, "surfaces": surfaces, "failures": failures})
    results["scenes"].sort(key=lambda s: (s["family"], s["seed"]))


def save(path, results):
    """Validates, and writes as a whole or not at all."""
    jsonschema.validate(results, json.loads(SCHEMA_FILE.read_text(encoding="utf-8")),
                        cls=jsonschema.Draft202012Validator)
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    partial = path.with_name(".partial-%d-%s" % (os.getpid(), path.name))
    partial.write_text(json.dumps(results, indent=1, allow_nan=False) + "\n", encoding="utf-8")
    os.replace(partial, path)
