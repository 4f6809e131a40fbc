#!/usr/bin/env python3
# Debian's Slurm on loopback, two nodes of one CPU each: the demo shot rendered on it equals the local render bit for bit, also
# with a node killed in the middle, and two nodes are faster than one where tasks run in parallel. Skips aloud without Slurm or
# without root. usage: slurm_full_test.py WEFT SOURCE
import filecmp
import json
import os
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

SKIP = 77
PARALLEL = ("weft-motion", "weft-frames")


def skip(why):
    print("SKIPPED:", why)
    sys.exit(SKIP)


def ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for s in sockets:
        s.bind(("127.0.0.1", 0))
    numbers = [s.getsockname()[1] for s in sockets]
    for s in sockets:
        s.close()
    return numbers


class Cluster:
    def __init__(self, folder):
        self.folder = folder
        self.nodes = {}
        control, first, second = ports(3)
        host = socket.gethostname()
        os.makedirs(folder + "/state")
        for node in ("n1", "n2"):
            os.makedirs(f"{folder}/spool_{node}")
        key = folder + "/munge.key"
        with open(key, "wb") as file:
            file.write(os.urandom(1024))
        os.chmod(key, 0o400)
        conf = f"""ClusterName=weft
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={control}
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CryptoType=crypto/munge
CommunicationParameters=NoInAddrAny,NoCtldInAddrAny
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool_%n
SlurmctldPidFile={folder}/ctld.pid
SlurmdPidFile={folder}/slurmd_%n.pid
SlurmctldLogFile={folder}/ctld.log
SlurmdLogFile={folder}/slurmd_%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
ReturnToService=2
SlurmdTimeout=10
KillWait=5
JobAcctGatherType=jobacct_gather/none
MpiDefault=none
SchedulerParameters=sched_interval=1,sched_min_interval=0,batch_sched_delay=0
NodeName=n1 NodeHostname={host} NodeAddr=127.0.0.1 Port={first} CPUs=1
NodeName=n2 NodeHostname={host} NodeAddr=127.0.0.1 Port={second} CPUs=1
PartitionName=all Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP
PartitionName=one Nodes=n1 MaxTime=INFINITE State=UP
"""
        self.conf = folder + "/slurm.conf"
        with open(self.conf, "w") as file:
            file.write(conf)
        self.env = dict(os.environ, SLURM_CONF=self.conf)
        self.munge = subprocess.Popen(["munged", "--foreground", "--force", "--key-file", key, "--socket",
                                       folder + "/munge.socket", "--pid-file", folder + "/munge.pid", "--log-file",
                                       folder + "/munge.log", "--seed-file", folder + "/munge.seed"])
        time.sleep(1)
        self.ctld = subprocess.Popen(["slurmctld", "-D", "-c", "-f", self.conf], env=self.env)
        time.sleep(1)
        for node in ("n1", "n2"):
            self.start(node)

    def start(self, node):
        self.nodes[node] = subprocess.Popen(["slurmd", "-D", "-N", node, "-f", self.conf], env=self.env)

    def call(self, *words):
        return subprocess.run(words, env=self.env, stdout=subprocess.PIPE, text=True).stdout.strip()

    def wait_idle(self):
        for _ in range(60):
            states = self.call("sinfo", "-h", "-o", "%T")
            if states and set(states.split()) == {"idle"}:
                return
            time.sleep(0.5)
        print(open(self.folder + "/ctld.log").read()[-3000:])
        skip("the nodes do not come up on this machine: " + self.call("sinfo"))

    def run(self, submit, env, disturb=None):
        """Seconds that tasks of each stage were in work, from the first one's start to the last one's end."""
        env = dict(self.env, **env)
        begun = time.time()
        subprocess.run(submit, env=env, check=True)
        seconds, before, held = {}, time.time(), set()
        while True:
            queue = self.call("squeue", "-h", "-o", "%j %T")
            now = time.time()
            stages = {line.split()[0] for line in queue.splitlines()}
            started = {line.split()[0] for line in queue.splitlines() if " RUNNING" in line}
            for stage in held & stages:
                seconds[stage] = seconds.get(stage, 0) + now - before
            before, held = now, (held | started) & stages
            if disturb and disturb(queue):
                disturb = None
            if not queue:
                return seconds
            if now - begun > 1800:
                print(queue)
                sys.exit("the job does not end")
            time.sleep(0.1)

    def stop(self):
        for process in [*self.nodes.values(), self.ctld, self.munge]:
            process.send_signal(signal.SIGTERM)
        for process in [*self.nodes.values(), self.ctld, self.munge]:
            try:
                process.wait(10)
            except subprocess.TimeoutExpired:
                process.kill()


def same(one, other):
    names = sorted(n for n in os.listdir(one) if not n.startswith("."))
    assert names and names == sorted(n for n in os.listdir(other) if not n.startswith(".")), (one, other)
    for name in names:
        assert filecmp.cmp(f"{one}/{name}", f"{other}/{name}", shallow=False), name


def main():
    weft, source = sys.argv[1:3]
    for tool in ("slurmctld", "slurmd", "sbatch", "munged"):
        if not shutil.which(tool):
            skip(f"there is no {tool} (apt install slurmctld slurmd slurm-client munge)")
    if os.geteuid() != 0:
        skip("Slurm's daemons want root")
    folder = tempfile.mkdtemp(prefix="weft_slurm_")
    os.chmod(folder, 0o755)
    cluster = None
    try:
        shutil.copytree(source + "/assets/demo", folder + "/demo")
        project = folder + "/demo/demo.weft"
        with open(project) as file:
            shot = json.load(file)
        shot["output"] = {"path": "out/####.png", "movie": "demo.mkv"}
        shot.setdefault("settings", {}).update({"quality": "draft", "frames": "1001-1024"})
        with open(project, "w") as file:
            json.dump(shot, file)
        out = folder + "/demo/out"
        env = {"WEFT": weft}

        def prepared(name, chunk):
            farm = f"{folder}/{name}"
            subprocess.run([weft, "submit", project, "--to", "slurm", "-o", farm, "--chunk", str(chunk), "--threads",
                            "1"], check=True, stdout=subprocess.DEVNULL)
            return [farm + "/submit.sh"] if os.access(farm + "/submit.sh", os.X_OK) else ["sh", farm + "/submit.sh"]

        subprocess.run([weft, "render", project, "--no-cache", "--threads", "1", "--backend", "cpu", "--progress", "none"],
                       check=True)
        shutil.move(out, folder + "/local")
        shutil.move(folder + "/demo/demo.mkv", folder + "/local.mkv")
        cluster = Cluster(folder)
        cluster.wait_idle()

        lost = []

        def lose_a_node(queue):
            if "weft-frames RUNNING" not in queue:
                return False
            victim = cluster.nodes["n2"]
            victim.kill()  # what it had started may go on writing: tasks are whole or not there
            victim.wait()
            lost.append(1)
            cluster.call("scontrol", "update", "nodename=n2", "state=down", "reason=killed")
            return True

        def rendered(name, chunk, partition, disturb=None):
            shutil.rmtree(out, ignore_errors=True)
            if os.path.exists(folder + "/demo/demo.mkv"):
                os.remove(folder + "/demo/demo.mkv")
            took = cluster.run(prepared(name, chunk), dict(env, WEFT_SBATCH="--partition=" + partition), disturb)
            same(folder + "/local", out)
            assert filecmp.cmp(folder + "/local.mkv", folder + "/demo/demo.mkv", shallow=False), "the movie"
            print(f"{name}: the bytes of the local render;", {k: round(v, 1) for k, v in took.items()}, flush=True)
            return took

        # Other work on the machine disturbs a comparison, so the best of three counts.
        best = 0
        for turn in range(3 if os.cpu_count() > 1 else 0):
            one = rendered(f"one_{turn}", 3, "one")
            two = rendered(f"two_{turn}", 3, "all")
            best = max(best, sum(one[s] for s in PARALLEL) / sum(two[s] for s in PARALLEL))
            print(f"two nodes: {best:.2f} times as fast as one", flush=True)
            if best >= 1.5:
                break
        assert best >= 1.5 or os.cpu_count() < 2, "two nodes gain too little"

        rendered("lost", 4, "all", lose_a_node)
        assert lost, "no node was lost while frames were rendered"
    finally:
        if cluster:
            cluster.stop()
        shutil.rmtree(folder, ignore_errors=True)


main()
