#!/bin/sh
# Some random scenes on both backends: `make random-scenes` renders more. The program lies beside rectray.
build=$(dirname "$RECTRAY")
exec "$PYTHON" tests/random/run.py "$build/compare_scenes" "$build/random-scenes" 50 1
