#!/bin/bash
# tests/distributions/run.sh [OPTION ..] [SUITE ..]: the README's two commands on bare Debians, as somebody new would type them.
# Needs root and debootstrap. For each SUITE (default: bookworm trixie) it makes a chroot, clones this repository's HEAD into it,
# runs the commands there and prints how long each took; nothing in it comes from this machine but the processor.
#   --mirror URL   where packages come from (default: the first Debian mirror in this machine's own apt configuration)
#   --folder DIR   where the chroots are made (default: /var/tmp/fsi-distributions); a chroot that is there is used again,
#                  the clone in it is not
#   --first        only the first command
#   --march ISA    with FSI_MARCH=ISA
# The logs are DIR/SUITE.log. Exit 1 where a command failed.
set -euo pipefail
root=$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")/../..
folder=/var/tmp/fsi-distributions mirror='' march=''
commands=('./launch/fsi run elastic_piston' './launch/fsi test')
suites=()
while (($# > 0)); do
  case $1 in
    --mirror) mirror=$2; shift ;;
    --folder) folder=$2; shift ;;
    --march) march="FSI_MARCH=$2 "; shift ;;
    --first) commands=("${commands[0]}") ;;
    -*) echo "no option $1; the head of $0 lists them" >&2; exit 2 ;;
    *) suites+=("$1") ;;
  esac
  shift
done
((${#suites[@]} > 0)) || suites=(bookworm trixie)
[[ $(id -u) == 0 ]] || { echo "$0: must be run as root" >&2; exit 2; }
command -v debootstrap >/dev/null || { echo "$0: takes debootstrap: apt-get install debootstrap" >&2; exit 2; }

# The first mirror of this machine that is no archive of security updates; nothing where there is none.
apt_mirror() {
  cat /etc/apt/sources.list.d/*.sources /etc/apt/sources.list /etc/apt/sources.list.d/*.list 2>/dev/null |
    sed -nE 's/^URIs: *//p; s/^deb +(\[[^]]*\] *)?([^ ]+).*/\2/p' | tr ' ' '\n' | grep -E -m 1 '/debian/?$' || true
}
[[ -n $mirror ]] || mirror=$(apt_mirror)
[[ -n $mirror ]] || { echo "$0: no mirror in the apt configuration; name one by --mirror" >&2; exit 2; }

mounted=()
unmount() {
  local k
  for ((k = ${#mounted[@]} - 1; k >= 0; --k)); do umount -l "${mounted[k]}"; done
  mounted=()
}
trap unmount EXIT

make_chroot() {  # make_chroot SUITE DIR LOG
  if [[ ! -e $2/etc/fsi-complete ]]; then
    rm -rf "$2"
    debootstrap --variant=minbase --include=git,ca-certificates "$1" "$2" "$mirror" >"$3" 2>&1 || { tail -n 3 "$3" >&2; return 1; }
    touch "$2/etc/fsi-complete"
  fi
  cp -L /etc/resolv.conf "$2/etc/resolv.conf"
  # As every installed system has it; without it mpirun asks the name server for localhost, and waits.
  printf '127.0.0.1 localhost\n' >"$2/etc/hosts"
  rm -rf "$2/root/amp-fsi"
  # An owner of its own: a clone, not a copy with what happens to lie here.
  git clone -q --no-hardlinks "$root" "$2/root/amp-fsi"
}

mount_into() {  # mount_into DIR
  mount -t proc proc "$1/proc" && mounted+=("$1/proc")
  mount --rbind /dev "$1/dev" && mount --make-rslave "$1/dev" && mounted+=("$1/dev")
  # Where tests of several hosts keep their networks: `ip netns` makes a mount of it, which would stay.
  mkdir -p "$1/run/netns" && mount --bind "$1/run/netns" "$1/run/netns" && mount --make-shared "$1/run/netns" && mounted+=("$1/run/netns")
}

failed=0
mkdir -p "$folder"
for suite in "${suites[@]}"; do
  directory=$folder/$suite log=$folder/$suite.log
  make_chroot "$suite" "$directory" "$log"
  mount_into "$directory"
  echo "== Debian $(cat "$directory/etc/debian_version") ($suite), commit $(git -C "$root" rev-parse --short HEAD)"
  for command in "${commands[@]}"; do
    echo "== $command" >>"$log"
    code=0
    TIMEFORMAT="%0R s, %0U s of processor time"
    spent=$({ time chroot "$directory" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin TERM=dumb LANG=C.UTF-8 \
      bash -c "cd /root/amp-fsi && $march$command" >>"$log" 2>&1 </dev/null || echo failed; } 2>&1) || code=1
    [[ $spent != *failed* ]] || code=1
    echo "$march$command: ${spent#failed?}$([[ $code == 0 ]] || echo ", FAILED, see $log")"
    ((code == 0)) || failed=1
  done
  chroot "$directory" bash -c 'cd /root/amp-fsi && ./launch/fsi --version' || failed=1
  unmount
done
exit "$failed"
