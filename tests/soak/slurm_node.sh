#!/usr/bin/env bash
# slurm_node.sh start|stop FOLDER: a Slurm of one node in a folder of its own (root; Debian: slurm-wlm).
set -eu
dir=$2
if [ "$1" = stop ]; then
  for pid in "$dir"/d.pid "$dir"/ctld.pid "$dir"/munged.pid; do [ -f "$pid" ] && kill "$(cat "$pid")"; done
  exit 0
fi
mkdir -p "$dir/state" "$dir/spool"
chmod 755 "$dir"
dd if=/dev/urandom of="$dir/munge.key" bs=1 count=1024 status=none
chmod 400 "$dir/munge.key"
munged --force --key-file="$dir/munge.key" --socket="$dir/munge.socket" --pid-file="$dir/munged.pid" \
  --log-file="$dir/munged.log" --seed-file="$dir/munge.seed"
host=$(hostname -s)
port=$((20000 + $$ % 20000))
cat > "$dir/slurm.conf" <<C
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$port
SlurmdPort=$((port + 1))
AuthType=auth/munge
AuthInfo=socket=$dir/munge.socket
CredType=cred/munge
SlurmUser=root
SlurmdUser=root
StateSaveLocation=$dir/state
SlurmdSpoolDir=$dir/spool
SlurmctldPidFile=$dir/ctld.pid
SlurmdPidFile=$dir/d.pid
SlurmctldLogFile=$dir/ctld.log
SlurmdLogFile=$dir/d.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerType=sched/builtin
MpiDefault=none
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc)
PartitionName=all Nodes=$host Default=YES State=UP
C
export SLURM_CONF="$dir/slurm.conf"
slurmctld
slurmd
for _ in $(seq 50); do
  sinfo --noheader --format=%t 2>/dev/null | grep -q idle && exit 0
  sleep 0.2
done
echo "the node did not come up" >&2
exit 1
