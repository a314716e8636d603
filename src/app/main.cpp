// The entry point of viete.
#include "app/program.h"

int main(int argc, char** argv) {
  return viete::app::run_program(argc, argv, viete::app::viete_program());
}
