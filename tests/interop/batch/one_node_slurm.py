"""A Slurm of one node on this machine alone, for as long as a test needs it: munged, slurmctld and
slurmd on loopback, without systemd, cgroups and accounting, everything in a folder of its own."""

import os
import pathlib
import secrets
import shutil
import signal
import socket
import subprocess
import time

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "sinfo", "squeue")


def missing():
    """Why there can be none; empty: there can."""
    lacking = [name for name in PROGRAMS if not shutil.which(name)]
    if lacking:
        return f"no {', '.join(lacking)} (packages slurm-wlm and munge)"
    return "" if os.geteuid() == 0 else "slurmd wants to be root"


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


class OneNodeSlurm:
    def __init__(self, folder, cpus=2):
        self.folder = pathlib.Path(folder)
        shutil.rmtree(self.folder, ignore_errors=True)
        for name in ("state", "spool", "munge", "log"):
            (self.folder / name).mkdir(parents=True)
        self.node = socket.gethostname().split(".")[0]
        self.cpus = cpus
        self.environment = dict(os.environ, SLURM_CONF=str(self.folder / "slurm.conf"))

    def __enter__(self):
        try:
            self.configure()
            self.start_munge()
            subprocess.run(["slurmctld", "-c"], env=self.environment, check=True)
            self.start_slurmd()
            self.wait_until_idle()
        except BaseException:
            self.stop()
            raise
        return self

    def __exit__(self, *_):
        self.stop()

    def configure(self):
        ctld, slurmd = free_ports(2)
        (self.folder / "slurm.conf").write_text(f"""ClusterName=one
SlurmctldHost={self.node}(127.0.0.1)
SlurmctldPort={ctld}
SlurmdPort={slurmd}
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
CredType=cred/munge
AuthInfo=socket={self.folder}/munge/socket
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
JobCompType=jobcomp/none
MpiDefault=none
ReturnToService=2
SlurmctldTimeout=300
SlurmdTimeout=300
SchedulerParameters=batch_sched_delay=0,sched_min_interval=0
StateSaveLocation={self.folder}/state
SlurmdSpoolDir={self.folder}/spool
SlurmctldPidFile={self.folder}/slurmctld.pid
SlurmdPidFile={self.folder}/slurmd.pid
SlurmctldLogFile={self.folder}/log/slurmctld.log
SlurmdLogFile={self.folder}/log/slurmd.log
NodeName={self.node} NodeAddr=127.0.0.1 CPUs={self.cpus} State=UNKNOWN
PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP
""")

    def start_munge(self):
        key = self.folder / "munge" / "key"
        key.write_bytes(secrets.token_bytes(1024))
        key.chmod(0o400)
        subprocess.run(["munged", "--force", f"--key-file={key}",
                        f"--socket={self.folder}/munge/socket",
                        f"--pid-file={self.folder}/munged.pid",
                        f"--log-file={self.folder}/log/munged.log",
                        f"--seed-file={self.folder}/munge/seed"], check=True)

    def start_slurmd(self):
        subprocess.run(["slurmd"], env=self.environment, check=True)

    def pid(self, daemon):
        try:
            return int((self.folder / f"{daemon}.pid").read_text())
        except (OSError, ValueError):
            return 0

    def kill_slurmd(self):
        if self.pid("slurmd"):
            os.kill(self.pid("slurmd"), signal.SIGKILL)

    def ask(self, *words):
        return subprocess.run(words, env=self.environment, check=True, capture_output=True,
                              text=True).stdout

    def wait_until_idle(self, seconds=60):
        end = time.time() + seconds
        while "idle" not in self.ask("sinfo", "-h", "-o", "%T"):
            if time.time() > end:
                raise RuntimeError("slurmd does not become idle:\n" +
                                   (self.folder / "log/slurmctld.log").read_text()[-2000:])
            time.sleep(0.2)

    def submit(self, *words):
        return self.ask("sbatch", "--parsable", *map(str, words)).strip().split(";")[0]

    def jobs(self):
        return self.ask("squeue", "-h", "-r", "-o", "%T").split()

    def wait_for_jobs(self, seconds=600):
        end = time.time() + seconds
        while self.jobs():
            if time.time() > end:
                raise RuntimeError("jobs do not end: " + self.ask("squeue"))
            time.sleep(0.3)

    def stop(self):
        for daemon in ("slurmd", "slurmctld", "munged"):
            pid = self.pid(daemon)
            if not pid:
                continue
            try:
                os.kill(pid, signal.SIGTERM)
                for _ in range(50):
                    os.kill(pid, 0)
                    time.sleep(0.1)
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
