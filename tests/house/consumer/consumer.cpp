// Writes a picture of a scene and reads it, through the module that reads pictures, which is opened at run time.
#include <meninas/meninas.h>

int main(int, char** arguments) {
  const meninas::Room room(arguments[1], {{"quality", "draft"}});
  room.render({{"size", "4x4"}}).write(arguments[2]);
  return meninas::RoomPicture::read(arguments[2]).width() == 4 ? 0 : 1;
}
