"""A table of the pairs of links that are nearest.

python nearest_pairs.py URDD [COUNT]
"""

import sys

import urdd

robot = urdd.load(sys.argv[1])
count = int(sys.argv[2]) if len(sys.argv) > 2 else 10
print(f"{'link':20} {'link':20} {'distance, m':>12} {'of the mean':>12}")
for pair in robot.nearest(robot.zero, count):
    relative = "" if pair.relative is None else f"{100 * pair.relative:11.1f}%"
    print(f"{pair.links[0]:20} {pair.links[1]:20} {pair.distance:12.4f} {relative:>12}")
