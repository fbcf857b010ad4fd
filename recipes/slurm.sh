#!/usr/bin/env bash
# Renders a scene in parts as an array of Slurm jobs, and merges them with a job that depends on all of them.
#
#     recipes/slurm.sh SCENE PARTS PICTURE [options of etendue render]
#
# Returns when both are queued; prints the number of the job that merges. A part is queued again when its node fails (--requeue), and its
# checkpoint lets it go on where it was. SBATCH_OPTIONS are options of sbatch for both, such as "--partition long --cpus-per-task 16".
set -euo pipefail

scene=$(realpath "$1") parts=$2 picture=$(realpath -m "$3")
shift 3
etendue=$(command -v "${ETENDUE:-etendue}")
folder=$picture.parts
mkdir -p "$folder"
options=$(printf ' %q' "$@")

# shellcheck disable=SC2086 # several options in one variable
array=$(sbatch --parsable --array "1-$parts" --requeue --output "$folder/%a.log" ${SBATCH_OPTIONS:-} <<SCRIPT
#!/usr/bin/env bash
exec "$etendue" render "$scene" --shard \$SLURM_ARRAY_TASK_ID/$parts -o "$folder/\$SLURM_ARRAY_TASK_ID.exr" \\
  --checkpoint "$folder/\$SLURM_ARRAY_TASK_ID.checkpoint:5min" --threads "\${SLURM_CPUS_PER_TASK:-1}" -q $options
SCRIPT
)
# shellcheck disable=SC2086
sbatch --parsable --dependency "afterok:$array" --output "$folder/merge.log" ${SBATCH_OPTIONS:-} <<SCRIPT
#!/usr/bin/env bash
exec "$etendue" merge "$folder"/*.exr -o "$picture" -q
SCRIPT
