#include "dragon/anatomy.h"

namespace viete::dragon {

Field dragon_field() {
  Field field;
  add_body(field);
  add_limbs(field);
  add_crest(field);
  add_head(field);
  add_wings(field);
  return field;
}

}  // namespace viete::dragon
