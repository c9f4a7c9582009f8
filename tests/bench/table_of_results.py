#!/usr/bin/env python3
"""Prints the table of README.md from a result of `spheroscope bench`.

    tests/bench/table_of_results.py tests/bench/results/xeon_avx512.csv
"""
import csv
import sys

METHOD = "linearly_implicit"


def read(path):
    """{(cells, nodes): {method: {threads: row}}}, all numbers as text."""
    sizes = {}
    with open(path, encoding="utf-8") as file:
        for row in csv.DictReader(line for line in file if not line.startswith("#")):
            size = sizes.setdefault((int(row["cells"]), int(row["nodes"])), {})
            size.setdefault(row["method"], {})[int(row["threads"])] = row
    return sizes


def second_thread(rows):
    """How many times faster two threads make a step."""
    return float(rows[1]["step_wall_ms"]) / float(rows[2]["step_wall_ms"])


def main(path):
    print("| cells x nodes | µs for each active pair | contact kernel over the plain one | "
          "second thread: this method, all methods | steps of `forward_euler` a second | MB a cell |")
    print("|---|---|---|---|---|---|")
    for (cells, nodes), methods in sorted(read(path).items(), key=lambda item: item[0][::-1]):
        if cells == 1:
            continue
        one = methods[METHOD][1]
        us = 1e3 * float(one["step_cpu_ms"]) / float(one["active_pairs"])
        kernel = float(one["ns_plain"]) / float(one["ns_per_active"])
        second = [second_thread(rows) for rows in methods.values()]
        euler = 1e3 / float(methods["forward_euler"][2]["step_wall_ms"])
        print(f"| {cells} x {nodes} | {us:.2f} | {kernel:.1f} | {second_thread(methods[METHOD]):.2f}, "
              f"{min(second):.2f} to {max(second):.2f} | {euler:.1f} | "
              f"{float(one['memory_MB']) / cells:.2f} |")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
