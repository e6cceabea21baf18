#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# four_hosts.sh MPIEXEC COMMAND...: runs a command by eight ranks on four network namespaces, which are hosts to MPI:
# each has its own name, its own address and no other network. Prints the command's output. Exit code 77: these
# namespaces cannot be made here. They have no connection to the network of the machine, and are gone afterwards.
set -u
mpiexec=$1
shift
id=rg$$
folder=$(mktemp -d) || exit 77

remove() {
  for n in 0 1 2 3 4; do ip netns del "$id-$n" 2>/dev/null; done
  rm -rf "$folder"
}
trap remove EXIT
trap 'exit 1' HUP INT TERM

[ "$(id -u)" = 0 ] || { echo "only the superuser can make network namespaces" >&2; exit 77; }
command -v ip >/dev/null || { echo "there is no program ip" >&2; exit 77; }

# Namespace 0 is the switch.
for n in 0 1 2 3 4; do
  ip netns add "$id-$n" 2>/dev/null || { echo "no network namespace can be made" >&2; exit 77; }
  ip -n "$id-$n" link set lo up
done
ip -n "$id-0" link add switch type bridge 2>/dev/null || { echo "no bridge can be made" >&2; exit 77; }
ip -n "$id-0" link set switch up
hosts=
for n in 1 2 3 4; do
  ip -n "$id-$n" link add net type veth peer name "port$n" netns "$id-0" || exit 77
  ip -n "$id-0" link set "port$n" master switch up
  ip -n "$id-$n" address add "192.0.2.$n/24" dev net
  ip -n "$id-$n" link set net up
  hosts="$hosts,192.0.2.$n:2"
done

# How MPI starts a program on a host, in the place of ssh: agent ADDRESS COMMAND.
cat >"$folder/agent" <<EOF
#!/bin/sh
host=\${1##*.}
shift
exec ip netns exec "$id-\$host" unshare --uts sh -c 'hostname host\$0 && exec sh -c "\$*"' "\$host" "\$@"
EOF
chmod +x "$folder/agent"

ip netns exec "$id-1" unshare --uts sh -c 'hostname host1 && exec "$@"' sh \
  "$mpiexec" --allow-run-as-root --mca plm_rsh_agent "$folder/agent" --mca oob_tcp_if_include 192.0.2.0/24 \
  --mca btl tcp,self --mca btl_tcp_if_include 192.0.2.0/24 --host "${hosts#,}" --map-by node -n 8 "$@"

