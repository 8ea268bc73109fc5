/* SPDX-License-Identifier: MIT */
/* Distances on a mesh from arrays, in C: docs/c.md shows it. */
#include <geotherm.h>
#include <stdio.h>

static int failed(void) {
  const char *message, *hint;
  geotherm_last_error(&message, &hint);
  fprintf(stderr, "error: %s; %s\n", message, hint);
  return 1;
}

int main(void) {
  float positions[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  int32_t faces[2][3] = {{0, 1, 2}, {0, 2, 3}};
  geotherm_shape shape = {.kind = GEOTHERM_TRIANGLES,
                          .positions = {positions, GEOTHERM_FLOAT32, 4, 3, 0, 0},
                          .cells = {faces, GEOTHERM_INT32, 2, 3, 0, 0}};
  geotherm_model *model = NULL;
  if (geotherm_model_build(&shape, NULL, NULL, &model) != GEOTHERM_OK) return failed();

  geotherm_options *options = NULL;
  geotherm_options_new(&options);
  if (geotherm_options_set(options, "method", "exact") != GEOTHERM_OK) return failed();
  geotherm_solver *solver = NULL;
  if (geotherm_solver_new(model, options, NULL, &solver) != GEOTHERM_OK) return failed();

  double distances[4];
  geotherm_array out = {distances, GEOTHERM_FLOAT64, 4, 1, 0, 0};
  geotherm_source source = {.kind = GEOTHERM_VERTEX, .id = 1};
  geotherm_sources sources = {.points = &source, .count = 1};
  if (geotherm_distance(solver, &sources, &out, NULL) != GEOTHERM_OK) return failed();
  for (int v = 0; v < 4; ++v) printf("%d: %g\n", v, distances[v]);

  geotherm_free(solver);
  geotherm_free(options);
  geotherm_free(model);
  return distances[1] == 0 && distances[0] == 1 ? 0 : 1;
}
