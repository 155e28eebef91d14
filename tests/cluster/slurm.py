"""A Slurm of this machine alone, for the tests: one controller, and nodes that are namespaces of their own, so that a
node can die with all its processes. Its files, keys and sockets lie in one folder; the system's own Slurm, where there
is one, is not touched."""
import os
import shutil
import signal
import socket
import subprocess
import time

PROGRAMS = ("slurmctld", "slurmd", "sbatch", "squeue", "sinfo", "scontrol", "munged", "unshare")

CONFIGURATION = """\
ClusterName=rectray
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={port}
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
StateSaveLocation={folder}/state
SlurmctldPidFile={folder}/slurmctld.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdSpoolDir={folder}/%n
SlurmdPidFile={folder}/%n.pid
SlurmdLogFile={folder}/%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SwitchType=switch/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdParameters=config_overrides
SchedulerParameters=batch_sched_delay=0,sched_min_interval=0
SlurmdTimeout=5
SlurmctldTimeout=5
MessageTimeout=5
KillWait=1
ReturnToService=2
PartitionName=all Nodes=ALL Default=YES State=UP
"""


def why_not():
    """Why it cannot run here; "" where it can."""
    missing = [name for name in PROGRAMS if not shutil.which(name)]
    if missing:
        return f"{', '.join(missing)} missing; .ci/setup cluster installs Slurm and munge"
    if os.geteuid() != 0:
        return "only root starts nodes in namespaces of their own"
    made = subprocess.run(["unshare", "--pid", "--fork", "--mount-proc", "--uts", "true"], capture_output=True)
    return "" if made.returncode == 0 else "this machine lets nobody make namespaces"


def free_port():
    with socket.socket() as s:
        s.bind(("127.0.0.1", 0))
        return s.getsockname()[1]


class Slurm:
    def __init__(self, folder, nodes):
        self.folder, self.nodes, self.processes = folder, {}, []
        self.environment = dict(os.environ, SLURM_CONF=os.path.join(folder, "slurm.conf"))
        os.makedirs(os.path.join(folder, "state"), exist_ok=True)
        text = CONFIGURATION.format(folder=folder, host=socket.gethostname(), port=free_port())
        for node in nodes:
            text += f"NodeName={node} NodeAddr=127.0.0.1 NodeHostname={node} Port={free_port()} CPUs=1 State=UNKNOWN\n"
        with open(self.environment["SLURM_CONF"], "w", encoding="utf-8") as file:
            file.write(text)
        try:
            self.start_munge()
            self.start(["slurmctld", "-D", "-c"], "slurmctld")
            for node in nodes:
                self.start_node(node)
            self.wait_for(lambda: self.said("sinfo", "-h", "-o", "%T %D") == f"idle {len(nodes)}", "nodes that idle")
        except BaseException:
            self.stop()
            raise

    def start(self, words, name):
        with open(os.path.join(self.folder, name + ".out"), "wb") as log:
            self.processes.append(subprocess.Popen(words, env=self.environment, stdin=subprocess.DEVNULL, stdout=log,
                                                   stderr=log))
        return self.processes[-1]

    def start_munge(self):
        def path(name):
            return os.path.join(self.folder, name)

        with open(path("munge.key"), "wb") as key:
            key.write(os.urandom(128))
        os.chmod(path("munge.key"), 0o400)
        self.start(["munged", "--foreground", "--force", "--key-file", path("munge.key"), "--socket",
                    path("munge.socket"), "--pid-file", path("munge.pid"), "--log-file", path("munge.log"),
                    "--seed-file", path("munge.seed")], "munged")
        self.wait_for(lambda: os.path.exists(path("munge.socket")), "munge")

    def start_node(self, node):
        script = f"hostname {node} && exec slurmd -D -N {node}"
        self.nodes[node] = self.start(["unshare", "--pid", "--fork", "--kill-child", "--mount-proc", "--uts", "sh",
                                       "-c", script], node)

    def kill_node(self, node):
        """As if the power failed: every process of the node ends at once."""
        self.nodes[node].kill()
        self.nodes[node].wait()

    def said(self, *words):
        return subprocess.run(words, env=self.environment, capture_output=True, text=True, check=False).stdout.strip()

    def submit(self, *words, **environment):
        done = subprocess.run(["sbatch", "--parsable", *words], env=dict(self.environment, **environment),
                              capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise RuntimeError(done.stderr)
        return done.stdout.strip()

    def wait_for(self, holds, what, seconds=120):
        end = time.monotonic() + seconds
        while not holds():
            if time.monotonic() > end:
                raise TimeoutError(f"no {what} after {seconds} s; the logs are in {self.folder}")
            time.sleep(0.1)

    def states(self, job):
        return self.said("squeue", "-h", "-r", "-j", job, "-t", "all", "-o", "%T").split()

    def hurry(self):
        """Slurm lets a task whose node has died wait for two minutes before it begins anew; here it need not."""
        for line in self.said("squeue", "-h", "-r", "-t", "PD", "-o", "%i %r").splitlines():
            task, reason = line.split(" ", 1)
            if reason == "BeginTime":
                self.said("scontrol", "update", f"JobId={task}", "StartTime=now")

    def stop(self):
        for process in reversed(self.processes):
            if process.poll() is None:
                process.send_signal(signal.SIGKILL if process in self.nodes.values() else signal.SIGTERM)
                process.wait()
