#!/bin/bash
# The frames of a film, or the parts of a picture, on hosts that ssh reaches, by GNU parallel:
#
#     docs/cluster/parallel.sh HOSTS N frames SCENE 'frames/%04d.png' [OPTION...]
#     docs/cluster/parallel.sh HOSTS N parts SCENE FOLDER [OPTION...]
#
# HOSTS is a file for `parallel --sshloginfile`: a host a line, such as 4/node1 for four tasks at once; `:` is this
# machine. N is how many tasks the work is divided into. The hosts share the folders of the scene and the pictures. A
# task that fails, or whose host dies, is tried up to three times, on another host where there is one. Run again, the
# script does what is missing.
set -euo pipefail
[ $# -ge 5 ] || { sed -n '2,/^set/{/^#/s/^#\( \|$\)//p}' "$0" >&2; exit 2; }
hosts=$1 n=$2 kind=$3 scene=$4 to=$5
shift 5
rectray=${RECTRAY:-rectray}
# Quoted twice: once for parallel's shell here, once for the shell there.
words=
[ $# -eq 0 ] || words=$(printf '%q ' "$@") # of no options printf would make one empty word
case $kind in
frames)
    mkdir -p "$(dirname "$to")"
    command=$(printf '%q render %q --frames all --part {}/%d --resume --progress never -q -o %q %s' \
        "$rectray" "$scene" "$n" "$to" "$words")
    ;;
parts)
    mkdir -p "$to"
    command=$(printf '[ -e %q/{}.png ] || %q render %q --part {}/%d --progress never -q -o %q/{}.png %s' \
        "$to" "$rectray" "$scene" "$n" "$to" "$words")
    ;;
*)
    echo "$kind: frames or parts?" >&2
    exit 2
    ;;
esac
# parallel runs each task in $SHELL; where that is not set, as in some services, it runs none and reports no failure.
export SHELL=$BASH PARALLEL_SHELL=$BASH
seq -w "$n" | parallel --sshloginfile "$hosts" --retries 3 --workdir "$PWD" --joblog "${JOBLOG:-/dev/null}" "$command"
[ "$kind" = frames ] || "$rectray" join "$to"/*.png -o "$to.png"
