// The dragon's shape: which parts it has, and where. It faces +x, stands on y = 0 and is about two and a half
// units long.
#pragma once

#include "dragon/field.h"

namespace viete::dragon {

Field dragon_field();

/// The parts of it, one file each, in the order in which they are joined.
void add_body(Field& field);   ///< trunk, neck and tail, with scales and belly plates
void add_limbs(Field& field);  ///< legs, toes, claws
void add_wings(Field& field);  ///< arms, fingers, skin
void add_crest(Field& field);  ///< the row of spines down the back, and the tip of the tail
void add_head(Field& field);   ///< skull, jaws, eyes, teeth, horns

}  // namespace viete::dragon
