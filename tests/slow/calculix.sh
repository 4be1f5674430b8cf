#!/bin/sh
# Decks as CalculiX understands them, beside closed forms; and a bowl by vesica and by CalculiX. Times are printed, not judged.
set -eu # Debian's own python3: the one that python3-numpy is for
/usr/bin/python3 "$1/tests/slow/calculix.py" "$1" "$2"
/usr/bin/python3 "$1/bench/peers/calculix/compare.py" "$2" --grids 80x96 --designs "start;Table 7.4, rim held" --check
