#!/usr/bin/env bash
# Slurm for real: a controller and two nodes, each in a network namespace of its own, joined by a bridge.
# usage: slurm_test.sh MENINAS SOURCE_FOLDER WORK_FOLDER; ends with 77 where there is no root or no Slurm.
#
#   1. meninas-slurm makes all pictures, with one solve in all, the bits of a run without Slurm.
#   2. A node is cut off in the middle: all pictures are there, nothing is partial, and nothing was made twice but
#      what was under way.
set -euo pipefail

program=$1 source=$2 work=$3
skip() { printf 'skipped: %s\n' "$1" && exit 77; }
fail() { printf 'FAILED: %s\n' "$1" && show_logs && exit 1; }
[[ $(id -u) == 0 ]] || skip 'network namespaces need root'
for tool in slurmctld slurmd sbatch squeue ip nsenter; do
  command -v "$tool" > /dev/null || skip "$tool is not installed: ./check --all installs slurm-wlm"
done

id=mf$$ net=10.$((RANDOM % 200 + 20)).$((RANDOM % 250))
rm -rf "$work" && mkdir -p "$work/state" "$work/spool"
started=()
show_logs() { tail -n 15 "$work"/*.log 2> /dev/null || true; }
clean_up() {
  for pid in "${started[@]}"; do kill -9 "$pid" 2> /dev/null || true; done
  for name in ctl n1 n2; do
    # Steps and pictures of a node that was cut off go on.
    ip netns pids "$id-$name" 2> /dev/null | xargs -r kill -9 2> /dev/null || true
    ip netns del "$id-$name" 2> /dev/null || true
  done
  ip link del "$id" 2> /dev/null || true
}
trap clean_up EXIT

problem=$(ip link add "$id" type bridge 2>&1) || skip "no bridge can be made: $problem"
ip link set "$id" up
k=0
for name in ctl n1 n2; do
  k=$((k + 1))
  problem=$(ip netns add "$id-$name" 2>&1) || skip "no network namespace can be made: $problem"
  ip link add "$id$k" type veth peer name eth0 netns "$id-$name"
  ip link set "$id$k" master "$id" up
  ip -n "$id-$name" addr add "$net.$k/24" dev eth0
  ip -n "$id-$name" link set eth0 up
  ip -n "$id-$name" link set lo up
done

cat > "$work/slurm.conf" << END
ClusterName=farm
SlurmctldHost=$(hostname -s)($net.1)
SlurmUser=root
AuthType=auth/none
CredType=cred/none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SwitchType=switch/none
SelectType=select/linear
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool/%n
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/%n.pid
SlurmctldLogFile=$work/slurmctld.log
SlurmdLogFile=$work/%n.log
SlurmctldTimeout=10
SlurmdTimeout=8
MessageTimeout=4
KillWait=2
MinJobAge=300
ReturnToService=2
JobRequeue=1
SchedulerParameters=batch_sched_delay=0,sched_interval=2,sched_min_interval=0,requeue_delay=1
SlurmdParameters=config_overrides
NodeName=n1 NodeHostname=$(hostname -s) NodeAddr=$net.2 CPUs=1 State=UNKNOWN
NodeName=n2 NodeHostname=$(hostname -s) NodeAddr=$net.3 CPUs=1 State=UNKNOWN
PartitionName=all Nodes=n1,n2 Default=YES MaxTime=60 State=UP
END
export SLURM_CONF=$work/slurm.conf
in_net() { local name=$1 && shift && nsenter --net="/run/netns/$id-$name" -- "$@"; }
begin() { in_net "$@" > /dev/null 2>&1 & started+=("$!"); }
begin ctl slurmctld -D -f "$SLURM_CONF"
for name in n1 n2; do
  mkdir -p "$work/spool/$name"
  begin "$name" slurmd -D -N "$name" -f "$SLURM_CONF"
done

# wait_for SECONDS WORDS COMMAND: until the command succeeds.
wait_for() {
  local seconds=$1 words=$2 && shift 2
  for ((s = 0; s < 2 * seconds; s++)); do
    if "$@" > /dev/null 2>&1; then return; fi
    sleep 0.5
  done
  fail "$words within $seconds seconds"
}
idle_nodes() { [[ $(in_net ctl sinfo -h -t idle -o %D) == 2 ]]; }
no_jobs() { [[ -z $(in_net ctl squeue -h) ]]; }
wait_for 60 'no two idle nodes' idle_nodes

cat > "$work/jobs.json" << END
{"jobs": [{"scenes": "$source/scenes/gallery/cornell-mirror.gltf", "cameras": {"name": "turn", "orbit": {"radius": 2.5}, "frames": 16},
  "settings": {"quality": "draft", "size": "320x240", "samples": 512}, "outputs": ["{frame}.exr", "{frame}.png"]}]}
END
"$program" batch "$work/jobs.json" -o "$work/alone" --quiet
submit() {
  in_net ctl "$source/integrations/slurm/meninas-slurm" "$work/jobs.json" -o "$work/$1" --tasks "$2" --program "$program"
}
made_in() { cat "$work/$1"/.meninas/slurm/*.log | grep -c ' s)$' || true; }
check() {
  for file in "$work"/alone/*.exr "$work"/alone/*.png; do
    cmp "$file" "$work/$1/$(basename "$file")" || fail "$1: a picture differs or is missing"
  done
  [[ $(find "$work/$1" -maxdepth 1 -name '*.exr' -o -maxdepth 1 -name '*.png' | wc -l) == 32 ]] || fail "$1: files too many"
  [[ -z $(find "$work/$1" -size 0 -name "*.[ep][xn][rg]") ]] || fail "$1: something partial is left"
  [[ -s $work/$1/index.html ]] || fail "$1: no page"
  [[ $(find "$work/$1/.meninas/solutions" -name '*.glb' | wc -l) == 1 ]] || fail "$1: not one solution"
}

submit whole 4
wait_for 240 'the array has not ended' no_jobs
check whole
[[ $(made_in whole) == 16 ]] || fail "whole: $(made_in whole) pictures were made, not 16"
printf 'whole: 16 pictures by 4 tasks on 2 nodes, once each, one solve, the same bits\n'

submit cut 2
some_made() { (($(made_in cut) >= 3)); }
wait_for 120 'no pictures' some_made
# The node is gone for the controller; what runs on it is ended, as when its power fails.
ip link set "${id}3" down
in_cut=$(in_net ctl squeue -h -t R -w n2 -o %K | head -1)
ip netns pids "$id-n2" | xargs -r kill -9 2> /dev/null || true
printf 'cut: node n2 with task %s, after %s pictures\n' "${in_cut:-none}" "$(made_in cut)"
wait_for 400 'the array has not ended' no_jobs
check cut
made=$(made_in cut)
((made >= 15 && made <= 17)) || fail "cut: $made pictures were made of 16"
in_net ctl sinfo -h -n n2 -o %T | grep -q down || fail 'cut: the node is not known to be down'
printf 'cut: all 16 pictures are there, whole, the same bits; %s were said to be made\n' "$made"
