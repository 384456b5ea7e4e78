"""A URDD of every URDF below some folders, by Ray: one task a robot, one bad robot never stops the rest.

python many_robots_ray.py OUTPUT FOLDER...                 on this machine, or the cluster that RAY_ADDRESS names
python many_robots_ray.py --workers 2 OUTPUT FOLDER...     on this machine, so many robots at a time

Ray listens to the network, on this machine too, and asks for a token (from 2.60 on): run it where that may be.
"""

import argparse
import json
from pathlib import Path

import ray

import urdd


@ray.remote(num_cpus=1)
def make(source, target):
    """Generates one URDD, on the one processor that Ray reserves for it."""
    urdd.set_num_threads(1)
    try:
        made = urdd.generate(source, target)
        (checked,) = urdd.validate(target).urdds
        return {"robot": str(source), "dofs": made.num_dofs, "verdict": checked.verdict}
    except urdd.GenerateError as error:
        return {"robot": str(source), "error": str(error)}


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--workers", type=int)
    parser.add_argument("output", type=Path)
    parser.add_argument("folders", nargs="+", type=Path)
    arguments = parser.parse_args()
    ray.init(num_cpus=arguments.workers, include_dashboard=False)
    jobs = urdd.find_urdfs(*arguments.folders)
    output = arguments.output.absolute()
    tasks = [make.remote(job.source.absolute(), output / job.name) for job in jobs]
    while tasks:
        done, tasks = ray.wait(tasks)
        print(json.dumps(ray.get(done[0])), flush=True)
