#!/usr/bin/env bash
# Makes an OpenFOAM case whose cells are polyhedra, with OpenFOAM's own programs (Debian: openfoam):
# a cavity of hexahedra, refined within a ball, its dual, and some steps of the flow under its lid.
#
#   polyhedral_cavity.sh DIRECTORY [CELLS_AN_EDGE]
set -euo pipefail
directory=$1 cells=${2:-16}
# Debian's programs do not know where their settings are.
export WM_PROJECT_DIR=${WM_PROJECT_DIR:-/usr/share/openfoam}
mkdir -p "$directory"/{system,constant,0}
cd "$directory"

foam() { # file, class, body on standard input
  { printf 'FoamFile { version 2.0; format ascii; class %s; object %s; }\n' "$2" "${1##*/}" && cat; } >"$1"
}
foam system/controlDict dictionary <<END
application icoFoam;
startFrom startTime; startTime 0;
stopAt endTime; endTime 0.5;
deltaT 0.01;
writeControl timeStep; writeInterval 50;
writeFormat ascii; writePrecision 9; timeFormat general;
END
foam system/fvSchemes dictionary <<END
ddtSchemes { default Euler; }
gradSchemes { default Gauss linear; }
divSchemes { default none; div(phi,U) Gauss upwind; }
laplacianSchemes { default Gauss linear corrected; }
interpolationSchemes { default linear; }
snGradSchemes { default corrected; }
END
foam system/fvSolution dictionary <<END
solvers
{
  p { solver PCG; preconditioner DIC; tolerance 1e-7; relTol 0.01; }
  pFinal { \$p; relTol 0; }
  U { solver smoothSolver; smoother symGaussSeidel; tolerance 1e-6; relTol 0; }
}
PISO { nCorrectors 2; nNonOrthogonalCorrectors 1; pRefCell 0; pRefValue 0; }
END
foam system/blockMeshDict dictionary <<END
vertices ((0 0 0) (1 0 0) (1 1 0) (0 1 0) (0 0 1) (1 0 1) (1 1 1) (0 1 1));
blocks (hex (0 1 2 3 4 5 6 7) ($cells $cells $cells) simpleGrading (1 1 1));
boundary
(
  lid { type wall; faces ((4 5 6 7)); }
  walls { type wall; faces ((0 3 2 1) (0 1 5 4) (1 2 6 5) (2 3 7 6) (3 0 4 7)); }
);
END
foam system/topoSetDict dictionary <<END
actions
({ name ball; type cellSet; action new; source sphereToCell; origin (0.7 0.5 0.75); radius 0.2; });
END
foam constant/transportProperties dictionary <<END
nu [0 2 -1 0 0 0 0] 0.01;
END
foam 0/p volScalarField <<END
dimensions [0 2 -2 0 0 0 0];
internalField uniform 0;
boundaryField { ".*" { type zeroGradient; } }
END
foam 0/U volVectorField <<END
dimensions [0 1 -1 0 0 0 0];
internalField uniform (0 0 0);
boundaryField { lid { type fixedValue; value uniform (1 0 0); } walls { type noSlip; } }
END

for step in "blockMesh" "topoSet" "refineHexMesh -overwrite ball" "polyDualMesh -overwrite 75" \
  "checkMesh" "icoFoam"; do
  # shellcheck disable=SC2086
  $step >"log.${step%% *}" 2>&1 || {
    tail -n 30 "log.${step%% *}" >&2
    exit 1
  }
done
rm -rf 0/cellLevel 0/pointLevel constant/polyMesh/sets
grep -E '^ +(hexahedra|prisms|wedges|pyramids|tet wedges|tetrahedra|polyhedra|cells|points|faces):' log.checkMesh
