#!/usr/bin/env bash
# A Slurm of one node on this machine, in a folder of its own, for as long as a command runs:
#
#     apt-get install slurm-wlm munge
#     validation/cluster/one_node_slurm.sh COMMAND ...      # as root; COMMAND finds sbatch, squeue, scontrol working
#
# No accounting, no cgroups: enough to run the job files of guide/cluster.md for real.
set -euo pipefail
home=$(mktemp -d /tmp/slurm.XXXXXX)
chmod 755 "$home"
node=$(hostname -s)
mkdir "$home/state" "$home/spool"
dd if=/dev/urandom of="$home/munge.key" bs=128 count=1 status=none
chmod 600 "$home/munge.key"
cat >"$home/slurm.conf" <<END
ClusterName=one
SlurmctldHost=$node(127.0.0.1)
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$home/munge.socket
StateSaveLocation=$home/state
SlurmdSpoolDir=$home/spool
SlurmctldPidFile=$home/slurmctld.pid
SlurmdPidFile=$home/slurmd.pid
SlurmctldLogFile=$home/slurmctld.log
SlurmdLogFile=$home/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
MpiDefault=none
ReturnToService=2
NodeName=$node NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
END
export SLURM_CONF=$home/slurm.conf

stop() {
  for name in slurmd slurmctld munged; do
    if [ -s "$home/$name.pid" ]; then kill "$(cat "$home/$name.pid")" 2>/dev/null || true; fi
  done
  sleep 1
  rm -rf "$home"
}
trap stop EXIT

munged --force --key-file="$home/munge.key" --socket="$home/munge.socket" --pid-file="$home/munged.pid" \
  --log-file="$home/munged.log" --seed-file="$home/munge.seed"
slurmctld -c
slurmd
for _ in $(seq 30); do
  if sinfo --noheader --format=%T 2>/dev/null | grep -q idle; then ready=yes; break; fi
  sleep 1
done
[ -n "${ready:-}" ] || { echo "no Slurm here:" >&2; tail -n 20 "$home"/*.log >&2; exit 1; }
"$@"
