#pragma once
// Internal: one function per family. Each draws its parameters from the dice and fills the surface.

#include "texture_db/starter/relief.h"

namespace weft::starter {

using Family = void (*)(Dice& dice, Relief& relief, Label& label);

void weave(Dice& dice, Relief& relief, Label& label);
void knit(Dice& dice, Relief& relief, Label& label);
void carpet(Dice& dice, Relief& relief, Label& label);
void leather(Dice& dice, Relief& relief, Label& label);
void scales(Dice& dice, Relief& relief, Label& label);
void fur(Dice& dice, Relief& relief, Label& label);
void grass(Dice& dice, Relief& relief, Label& label);
void straw(Dice& dice, Relief& relief, Label& label);
void foliage(Dice& dice, Relief& relief, Label& label);
void wood(Dice& dice, Relief& relief, Label& label);
void bark(Dice& dice, Relief& relief, Label& label);
void brick(Dice& dice, Relief& relief, Label& label);
void tiles(Dice& dice, Relief& relief, Label& label);
void stone(Dice& dice, Relief& relief, Label& label);
void cobblestone(Dice& dice, Relief& relief, Label& label);
void roof(Dice& dice, Relief& relief, Label& label);
void plaster(Dice& dice, Relief& relief, Label& label);
void concrete(Dice& dice, Relief& relief, Label& label);
void asphalt(Dice& dice, Relief& relief, Label& label);
void dirt(Dice& dice, Relief& relief, Label& label);
void sand(Dice& dice, Relief& relief, Label& label);
void gravel(Dice& dice, Relief& relief, Label& label);
void snow(Dice& dice, Relief& relief, Label& label);
void marble(Dice& dice, Relief& relief, Label& label);
void ceramic(Dice& dice, Relief& relief, Label& label);
void lava(Dice& dice, Relief& relief, Label& label);
void water(Dice& dice, Relief& relief, Label& label);
void metal(Dice& dice, Relief& relief, Label& label);
void rust(Dice& dice, Relief& relief, Label& label);
void rubber(Dice& dice, Relief& relief, Label& label);
void paper(Dice& dice, Relief& relief, Label& label);
void wallpaper(Dice& dice, Relief& relief, Label& label);

}  // namespace weft::starter
