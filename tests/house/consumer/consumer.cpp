// Writes a picture and reads it, through the module that reads pictures, which is opened at run time.
#include "image/image_file.h"
#include "raytrace/two_pass.h"

int main(int, char** arguments) {
  meninas::write_png(arguments[1], meninas::Image(4, 4), 0.0);
  return meninas::read_image(arguments[1]).picture.width == 4 ? 0 : 1;
}
