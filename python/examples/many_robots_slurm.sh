#!/bin/bash
# A URDD of every URDF below a folder, by an array of Slurm jobs:
#
#     sbatch --array=1-8 many_robots_slurm.sh FOLDER OUTPUT
#
# Each job makes its share of the robots; their names are the same whatever the number of jobs. A job that is run again
# makes only what changed.
#SBATCH --cpus-per-task=2
#SBATCH --job-name=urdd
set -euo pipefail
folder="$1"
output="$2"
mkdir -p "$output"
status=0
urdd generate "$folder" -o "$output" --threads "${SLURM_CPUS_PER_TASK:-1}" \
    --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT" \
    --format json > "$output/$SLURM_ARRAY_TASK_ID.jsonl" || status=$?
# 1: some robots could not be made; which, and why, stands in the file.
[ "$status" -le 1 ]
