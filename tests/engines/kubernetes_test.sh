#!/usr/bin/env bash
# The pods of the Kubernetes manifest, by hand: its container's command once for each index, all at the same time, in a
# folder that stands for the volume. All pictures, each once, one solve, the bits of one process.
# With KUBERNETES_OPENAPI=swagger.json (of https://github.com/kubernetes-client/python) the manifest must fit that schema, too.
# usage: kubernetes_test.sh MENINAS SOURCE_FOLDER WORK_FOLDER; ends with 77 where Python cannot read YAML.
set -euo pipefail

program=$1 source=$2 work=$3
# shellcheck source=tests/engines/farm.sh
source "$source/tests/engines/farm.sh"
manifest=$source/integrations/kubernetes/meninas-batch.yaml
python=/usr/bin/python3
"$python" -c 'import yaml' 2> /dev/null || skip 'python3-yaml is not installed: ./check --all installs it'

if [[ -n ${KUBERNETES_OPENAPI:-} ]]; then
  "$python" "$source/tests/engines/kubernetes_schema.py" "$KUBERNETES_OPENAPI" "$manifest" || fail 'the manifest does not fit the schema'
fi

# The number of pods, and the arguments of one, each in a line.
pod() {
  "$python" -c '
import sys, yaml
job = yaml.safe_load(open(sys.argv[1]))["spec"]
assert job["completionMode"] == "Indexed" and job["template"]["spec"]["restartPolicy"] == "Never"
container, = job["template"]["spec"]["containers"]
assert [mount["mountPath"] for mount in container["volumeMounts"]] == ["/shared"]
print(job["completions"], *container["args"], sep="\n")' "$manifest"
}
mapfile -t lines < <(pod)
completions=${lines[0]}
((completions > 1)) || fail 'the manifest has no pods'

prepare
mkdir shared && cp jobs.json room.gltf shared
pods=()
trap 'kill "${pods[@]}" 2> /dev/null || true; wait' EXIT # where one fails, the others end too
for ((index = 0; index < completions; index++)); do
  arguments=()
  for argument in "${lines[@]:1}"; do
    argument=${argument//'$(JOB_COMPLETION_INDEX)'/$index} # as the node's kubelet does
    arguments+=("${argument//\/shared/$work/shared}")
  done
  meninas "${arguments[@]}" > "pod-$index.log" 2>&1 &
  pods+=("$!")
done
for ((index = 0; index < completions; index++)); do
  wait "${pods[index]}" || fail "pod $index: $(< "pod-$index.log")"
done
cat pod-*.log > log
check_folder shared/rooms log
printf '%s pods: %s pictures, once each, one solve, the same bits\n' "$completions" "$pictures"
