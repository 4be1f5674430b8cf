#!/usr/bin/env python3
"""Pure random search as a method for vesica bench: program: [python3, ./random.py]."""
import json, random, sys

problem = json.loads(sys.stdin.readline())
random.seed(problem["seed"])
while True:
    print(json.dumps({"ask": [random.random() for _ in range(problem["n"])]}), flush=True)
    answer = json.loads(sys.stdin.readline())
    if "done" in answer:
        break
