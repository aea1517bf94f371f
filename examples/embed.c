/* A host program in C: the same two tetrahedra as in embed.cpp. */

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "plume/capi/plume_c.h"

static void check(plume_status status) {
  if (status == PLUME_OK) return;
  fprintf(stderr, "%s\n", plume_last_error());
  exit(1);
}

static int add_up(void* user, const plume_segment* segment) {
  *(double*)user += 0.5 * (segment->s_in + segment->s_out) * (segment->t_out - segment->t_in);
  return 1;
}

int main(void) {
  static const double points[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
  static const int32_t tetrahedra[] = {0, 1, 2, 3, 4, 1, 3, 2};
  static const uint8_t types[] = {10};
  static const float pressure[] = {1, 2, 3, 4, 5};
  static float rgba[4 * 64 * 64];
  const plume_array none = {NULL, 0, PLUME_INT32};

  plume_mesh* mesh;
  check(plume_mesh_of_cells((plume_array){points, 15, PLUME_FLOAT64},
                            (plume_array){types, 1, PLUME_UINT8}, none,
                            (plume_array){tetrahedra, 8, PLUME_INT32}, &mesh));
  check(plume_mesh_add_field(mesh, "pressure", PLUME_POINT, 1,
                             (plume_array){pressure, 5, PLUME_FLOAT32}));
  plume_scene* scene;
  check(plume_scene_create(mesh, "pressure", PLUME_DEFAULT, &scene));
  plume_mesh_free(mesh);

  plume_camera camera;
  check(plume_camera_view(scene, "iso", 1, &camera));
  check(plume_render(scene, &camera, NULL, 64, 64, rgba));
  printf("Plume %s: the middle pixel is %.3f opaque\n", plume_version(),
         rgba[4 * (32 * 64 + 32) + 3]);

  const double origin[] = {-1, -1, -1}, third = 0.57735026918962576;
  const double direction[] = {third, third, third};
  double integral = 0;
  check(plume_trace(scene, origin, direction, add_up, &integral));
  printf("integral of the pressure along the diagonal: %.6f\n", integral);
  plume_scene_free(scene);
  return 0;
}
