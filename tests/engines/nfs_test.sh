#!/usr/bin/env bash
# Locks over NFS for real: three small machines (User Mode Linux, the kernel as a program) in a network namespace. One
# exports a folder by the kernel's NFS server, two mount it (NFS 4.2) and make the pictures of one batch at the same time.
# usage: nfs_test.sh MENINAS SOURCE_FOLDER WORK_FOLDER; ends with 77 where there is no root, no user-mode-linux or no
# nfs-kernel-server, or where the machines do not come up.
#
#   1. A lock that one machine holds is not had by the other.
#   2. All pictures are there, with the bits of a run on one machine, each was made once, with one solve in all.
#   3. A machine is cut off in the middle: the other makes what is missing, and nothing twice but what was under way.
set -euo pipefail

program=$1 source=$2 work=$3
# shellcheck source=tests/engines/farm.sh
source "$source/tests/engines/farm.sh"
[[ $(id -u) == 0 ]] || skip 'network namespaces need root'
for tool in linux.uml exportfs rpc.nfsd rpc.mountd mount.nfs4 ip nsenter flock; do
  command -v "$tool" > /dev/null || skip "$tool is not installed: apt-get install user-mode-linux nfs-kernel-server iproute2"
done
modules=$(find /usr/lib/uml/modules -mindepth 1 -maxdepth 1 | head -n 1)
[[ -n $modules ]] || skip 'user-mode-linux has no modules'

prepare '"size": "320x240", "samples": 64' # so that pictures take longer than messages between the machines
id=mn$$ started=()
clean_up() {
  for pid in "${started[@]}"; do kill "$pid" 2> /dev/null || true; done
  sleep 0.5
  ip netns pids "$id" 2> /dev/null | xargs -r kill -9 2> /dev/null || true
  ip netns del "$id" 2> /dev/null || true
}
trap clean_up EXIT
problem=$(ip netns add "$id" 2>&1) || skip "no network namespace can be made: $problem"
ip -n "$id" link add bridge type bridge 2> /dev/null || skip 'no bridge can be made'
ip -n "$id" link set bridge up
for k in 1 2 3; do
  ip -n "$id" tuntap add dev "tap$k" mode tap 2> /dev/null || skip 'no tap device can be made'
  ip -n "$id" link set "tap$k" master bridge
  ip -n "$id" link set "tap$k" up
done
mkdir -p machine/lib/modules && ln -s "$modules" machine/lib/modules/

# What each machine does when it comes up: $1 is its number, the last part of its address.
cat > machine/init << END
#!/bin/sh
export PATH=$work/bin:/usr/sbin:/usr/bin:/sbin:/bin HOME=/run
mount -t proc proc /proc
mount -t sysfs sys /sys
# The server takes clients of one name for one client that has started anew, and drops its locks.
hostname machine-\$k
mount -t tmpfs run /run
mount -t tmpfs nfs /var/lib/nfs
mkdir -p /run/rooms /run/rpc_pipefs /var/lib/nfs/rpc_pipefs /var/lib/nfs/v4recovery /var/lib/nfs/sm
touch /var/lib/nfs/rmtab /var/lib/nfs/etab /var/lib/nfs/xtab
ip link set lo up
ip addr add 10.9.8.\$k/24 dev vec0
ip link set vec0 up
for module in nfs nfsv4 nfsd; do modprobe -d $work/machine \$module; done
cd $work
if [ \$k = 1 ]; then
  mount -t nfsd nfsd /proc/fs/nfsd
  exportfs -o rw,no_root_squash,no_subtree_check,fsid=0,insecure '10.9.8.0/24:/run/rooms'
  rpc.mountd -N 3
  echo /var/lib/nfs/v4recovery > /proc/fs/nfsd/nfsv4recoverydir 2> /dev/null
  rpc.nfsd -N 3 -L 10 -G 10 2
  : > up-1
  while [ ! -e cut-done-3 ]; do sleep 0.3; done
  cp -r /run/rooms/. $work/nfs
  : > copied
else
  n=0
  until mount -t nfs4 -o vers=4.2,sec=sys,hard,timeo=50 10.9.8.1:/ /run/rooms; do
    n=\$((n + 1)); [ \$n -gt 40 ] && break
    sleep 0.5
  done
  grep nfs4 /proc/mounts > mounted-\$k
  # A lock that the second machine holds for as long as the third asks for it.
  if [ \$k = 2 ]; then
    flock -n /run/rooms/lock sh -c ': > held; while [ ! -e asked ]; do sleep 0.1; done'
  else
    while [ ! -e held ]; do sleep 0.1; done
    if flock -n /run/rooms/lock true; then echo free > asked; else echo held > asked; fi
  fi
  : > ready-\$k
  while [ ! -e ready-2 ] || [ ! -e ready-3 ]; do sleep 0.1; done
  meninas batch jobs.json -o /run/rooms/whole --resume --threads 1 > whole-\$k.log 2>&1
  echo \$? > whole-done-\$k
  while [ ! -e whole-done-2 ] || [ ! -e whole-done-3 ]; do sleep 0.1; done
  # The third joins when the second is under way, or else it may have made all before.
  while [ \$k = 3 ] && [ ! -e joins ]; do sleep 0.1; done
  meninas batch jobs.json -o /run/rooms/cut --resume --threads 1 > cut-\$k.log 2>&1
  echo \$? > cut-done-\$k
  umount /run/rooms
fi
sync
halt -f -p
END
chmod +x machine/init
for k in 1 2 3; do
  nsenter --net="/run/netns/$id" -- linux.uml mem=768M root=/dev/root rootfstype=hostfs rootflags=/ rw k=$k init="$work/machine/init" \
    vec0:transport=tap,ifname=tap$k,depth=128 umid="$id-$k" uml_dir="$work/machine" con=null con0=null,fd:1 ssl=null \
    < /dev/null > "machine-$k.log" 2>&1 &
  started+=("$!")
done

# wait_for SECONDS CONDITION
wait_for() {
  for ((s = 0; s < 5 * $1; s++)); do
    if eval "$2"; then return; fi
    sleep 0.2
  done
  return 1
}
made() { cat "$@" 2> /dev/null | grep -c ' s)$' || true; }

if ! wait_for 120 '[[ -s mounted-2 && -s mounted-3 ]]'; then
  tail -n 5 machine-*.log
  skip 'the machines did not come up, or did not mount the folder'
fi
wait_for 200 '[[ -s whole-done-2 && -s whole-done-3 ]]' || fail "two machines have not ended: $(tail -n 2 whole-?.log)"
[[ $(< asked) == held ]] || fail 'a lock that one machine holds was had by the other'

wait_for 100 '(($(made cut-2.log) >= 1))' || fail "no pictures: $(tail -n 2 cut-2.log)"
: > joins
wait_for 100 '(($(made cut-2.log) >= 2)) || [[ -s cut-done-3 ]]' || fail "no pictures: $(tail -n 2 cut-?.log)"
[[ ! -s cut-done-3 ]] || fail 'all pictures were made before a machine could be cut off'
ip -n "$id" link set tap2 down
at_once=$(made cut-2.log)
((at_once < pictures)) || fail 'the machine that was cut off had made all pictures'
wait_for 200 '[[ -e copied ]]' || fail "the machine that is left has not ended: $(tail -n 2 cut-3.log)"

for name in whole-2 whole-3 cut-3; do
  [[ $(< "${name/-/-done-}") == 0 ]] || fail "$name: $(cat "$name.log")"
done
cat whole-?.log > log
check_folder nfs/whole log
printf 'NFS: %s\n' "$(sed 's/.*\(vers=[0-9.]*\).*\(local_lock=[a-z]*\).*/\1, \2/' mounted-2)"
printf 'whole: %s pictures by two machines (%s and %s), once each, one solve, the same bits\n' "$pictures" "$(made whole-2.log)" "$(made whole-3.log)"
# Of the picture that was under way the first machine may have told, or not; the other may have found it, or made it.
all=$(made cut-?.log)
((all >= pictures - 1 && all <= pictures + 1)) || fail "cut: $all pictures were made of $pictures"
for ((k = 0; k < pictures; k++)); do printf ' s)\n'; done > log
check_folder nfs/cut log
printf 'cut: a machine was cut off after %s pictures; all %s are there, the same bits; %s were said to be made\n' "$at_once" "$pictures" "$all"
