// SPDX-License-Identifier: Apache-2.0
// Asks a kinematics module of LinuxCNC, without its real-time environment, whose few functions that
// such a module calls stand below:
//
//     linuxcnc_kinematics MODULE.so [PIN=VALUE]... < JOINTS > WORLD
//
// A line of joints (mm, degrees) gives a line of world coordinates x y z a b c u v w, every digit.
// A pin is named by what stands behind its module's name ("y-offset").
#include <dlfcn.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { most_joints = 9, most_pins = 64 };

struct Pose {
  double x, y, z, a, b, c, u, v, w;
};

static struct {
  char name[128];
  double value;
} pins[most_pins];
static int pin_count;

static double* new_pin(const char* name) {
  if (pin_count == most_pins) exit(2);
  snprintf(pins[pin_count].name, sizeof pins[0].name, "%s", name);
  return &pins[pin_count++].value;
}

int hal_init(const char* name) { return name != NULL; }
int hal_ready(int id) { return id < 0; }
int hal_exit(int id) { return id < 0; }
int hal_export_funct(const char* name, void* act, void* with, int uses_fp, int reentrant, int id) {
  return name == NULL || act == NULL || with == NULL || uses_fp < 0 || reentrant < 0 || id < 0;
}
int hal_set_constructor(int id, void* make) { return id < 0 || make == NULL; }
void* hal_malloc(long size) { return calloc(1, (size_t)size); }
int hal_pin_float_newf(int direction, double** data, int id, const char* format, ...) {
  char name[128];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(name, sizeof name, format, arguments);
  va_end(arguments);
  *data = new_pin(name);
  return direction < 0 || id < 0;
}
int hal_pin_float_new(const char* name, int direction, double** data, int id) {
  *data = new_pin(name);
  return direction < 0 || id < 0;
}
int hal_pin_bit_new(const char* name, int direction, void** data, int id) {
  *data = new_pin(name);
  return direction < 0 || id < 0;
}
int hal_pin_s32_new(const char* name, int direction, void** data, int id) {
  *data = new_pin(name);
  return direction < 0 || id < 0;
}
int rtapi_print(const char* format, ...) { return format == NULL; }
int rtapi_print_msg(int level, const char* format, ...) { return level < 0 || format == NULL; }
int rtapi_snprintf(char* text, size_t size, const char* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  const int count = vsnprintf(text, size, format, arguments);
  va_end(arguments);
  return count;
}

static int set_pin(const char* setting) {
  const char* value = strchr(setting, '=');
  if (value == NULL) return 0;
  const size_t length = (size_t)(value - setting);
  for (int i = 0; i < pin_count; ++i) {
    const char* name = strrchr(pins[i].name, '.');
    name = name == NULL ? pins[i].name : name + 1;
    if (strlen(name) != length || strncmp(name, setting, length) != 0) continue;
    pins[i].value = strtod(value + 1, NULL);
    return 1;
  }
  return 0;
}

int main(int count, char** arguments) {
  if (count < 2) return 2;
  void* module = dlopen(arguments[1], RTLD_NOW);
  if (module == NULL) {
    fprintf(stderr, "%s\n", dlerror());
    return 1;
  }
  int (*start)(void);
  int (*forward)(const double*, struct Pose*, const unsigned long*, unsigned long*);
  *(void**)&start = dlsym(module, "rtapi_app_main");
  *(void**)&forward = dlsym(module, "kinematicsForward");
  if (start == NULL || forward == NULL || start() < 0) return 1;
  for (int i = 2; i < count; ++i) {
    if (set_pin(arguments[i])) continue;
    fprintf(stderr, "no pin %s\n", arguments[i]);
    return 1;
  }
  char line[1024];
  while (fgets(line, sizeof line, stdin) != NULL) {
    double joints[most_joints] = {0};
    char* at = line;
    for (int i = 0; i < most_joints; ++i) joints[i] = strtod(at, &at);
    struct Pose world = {0};
    const unsigned long forward_flags = 0;
    unsigned long inverse_flags = 0;
    if (forward(joints, &world, &forward_flags, &inverse_flags) != 0) return 1;
    printf("%.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g\n", world.x, world.y, world.z,
           world.a, world.b, world.c, world.u, world.v, world.w);
  }
  return 0;
}
