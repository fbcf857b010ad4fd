#!/usr/bin/env bash
# Runs every recipe whose engine is installed, with a small scene, and compares the picture with that of one machine, byte by byte.
#
#     apt install parallel slurm-wlm; pip install ray openjd-cli
#     recipes/check.sh [parallel|slurm|ray|openjd ...]
#
# ETENDUE is the command (target/release/etendue if not given), PYTHON the Python that has Ray. For Slurm a cluster of this one node
# is started if none answers, which takes root.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
export ETENDUE
ETENDUE=$(realpath "${ETENDUE:-$here/../target/release/etendue}")
PYTHON=${PYTHON:-python3}
scene=$here/../scenes/cornell-box/scene.xml
options=(--size 64x48 --spp 10)
work=$(mktemp -d)
started=()
trap 'for pid in "${started[@]}"; do kill "$pid" 2>/dev/null || true; done; rm -rf "$work"' EXIT

"$ETENDUE" render "$scene" "${options[@]}" -o "$work/whole.pfm" -q

same() { # ENGINE: its picture is that of one machine
  if cmp -s "$work/$1.pfm" "$work/whole.pfm"; then
    echo "$1: the same picture"
  else
    echo "$1: another picture, or none"
    exit 1
  fi
}

run_parallel() {
  "$here/parallel.sh" "$scene" 4 "$work/parallel.pfm" "${options[@]}"
  # A second run finds all parts.
  "$here/parallel.sh" "$scene" 4 "$work/parallel.pfm" "${options[@]}"
}

node() { # a cluster of this machine
  mkdir -p /run/munge "$work/slurm/spool" "$work/slurm/state"
  pgrep -x munged >/dev/null || { chown munge /run/munge; runuser -u munge -- /usr/sbin/munged --force; }
  cat >"$work/slurm/slurm.conf" <<CONF
ClusterName=one
SlurmctldHost=$(hostname -s)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
StateSaveLocation=$work/slurm/state
SlurmdSpoolDir=$work/slurm/spool
SlurmctldPidFile=$work/slurm/slurmctld.pid
SlurmdPidFile=$work/slurm/slurmd.pid
ReturnToService=2
NodeName=$(hostname -s) CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF
  export SLURM_CONF=$work/slurm/slurm.conf
  slurmctld -D >"$work/slurm/slurmctld.log" 2>&1 &
  started+=($!)
  slurmd -D >"$work/slurm/slurmd.log" 2>&1 &
  started+=($!)
  for _ in $(seq 60); do
    [ "$(sinfo -h -o %t 2>/dev/null)" = idle ] && return
    sleep 0.5
  done
  tail "$work"/slurm/*.log
  exit 1
}

run_slurm() {
  timeout 5 sinfo >/dev/null 2>&1 || node
  local last
  last=$("$here/slurm.sh" "$scene" 4 "$work/slurm.pfm" "${options[@]}")
  for _ in $(seq 120); do
    [ -z "$(squeue -h -j "$last" 2>/dev/null)" ] && break
    sleep 0.5
  done
  cat "$work"/slurm.pfm.parts/*.log
}

run_ray() { "$PYTHON" "$here/ray_render.py" "$scene" 4 "$work/ray.pfm" "${options[@]}"; }

run_openjd() {
  local openjd
  openjd=$(dirname "$(command -v "$PYTHON")")/openjd
  [ -x "$openjd" ] || openjd=openjd
  for step in Draw Merge; do
    "$openjd" run "$here/openjd.yaml" --step "$step" -p "Scene=$scene" -p "Picture=$work/openjd.pfm" \
      -p "Etendue=$ETENDUE" -p "Options=${options[*]}" >"$work/openjd.log" || { cat "$work/openjd.log"; exit 1; }
  done
}

has() {
  case $1 in
    parallel) command -v parallel >/dev/null ;;
    slurm) command -v slurmctld >/dev/null ;;
    ray) "$PYTHON" -c 'import ray' 2>/dev/null ;;
    openjd) command -v openjd >/dev/null || [ -x "$(dirname "$(command -v "$PYTHON")")/openjd" ] ;;
  esac
}

engines=("$@")
[ $# -gt 0 ] || engines=(parallel slurm ray openjd)
for engine in "${engines[@]}"; do
  if has "$engine"; then
    "run_$engine"
    same "$engine"
  else
    echo "$engine: left out, it is not installed"
  fi
done
