#!/usr/bin/env bash
# Shows that check_layers.sh notices: a small tree that keeps the rules passes, and each single line that breaks one
# fails with that file's name.
set -euo pipefail
here=$(cd -- "$(dirname -- "$0")" && pwd)
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
mkdir -p "$tree"/core/{mesh,smoothing,quality} "$tree"/app/{model,ui,render,window,cli}
printf '#include "mesh/topology.h"\n#include <vector>\n' >"$tree/core/smoothing/run.cpp"
printf '#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>\n' >"$tree/core/mesh/halfedge_mesh.cpp"
printf '#include <glad/gl.h>\n#include "mesh/topology.h"\n' >"$tree/app/render/frame.cpp"
printf '#include "cli/command.h"\n' >"$tree/app/main.cpp"
"$here/check_layers.sh" "$tree" >/dev/null || { echo 'a tree that keeps the rules was refused'; exit 1; }

failed=0
# breaks FILE LINE: with LINE in FILE the check must fail and name FILE.
breaks() {
  printf '%s\n' "$2" >"$tree/$1"
  if said=$("$here/check_layers.sh" "$tree") || [[ $said != *"$1:1:"* ]]; then
    printf 'not noticed: %s in %s\n' "$2" "$1"
    failed=1
  fi
  rm "$tree/$1"
}
breaks core/mesh/a.cpp '#include "smoothing/run.h"'
breaks core/quality/a.h '#include "smoothing/run.h"'
breaks core/smoothing/a.cpp '#  include "model/session.h"'
breaks core/smoothing/b.cpp '#include <glad/gl.h>'
breaks core/smoothing/c.cpp '#include <iostream>'
breaks core/mesh/topology.cpp '#include <OpenMesh/Core/IO/MeshIO.hh>'
breaks app/model/a.cpp '#include <imgui.h>'
breaks app/model/b.cpp '#include "render/scene.h"'
breaks app/ui/a.cpp '#include <GL/gl.h>'
breaks app/ui/b.cpp '#include "render/renderer.h"'
breaks app/ui/c.cpp '#include <GLFW/glfw3.h>'
breaks app/render/a.cpp '#include <imgui.h>'
breaks app/render/b.h '#include "model/session.h"'
breaks app/cli/a.cpp '#include <EGL/egl.h>'
breaks app/main2.cpp '#include "mesh/topology.h"'
breaks app/window/a.cpp '#include "window.h"'
exit $failed
