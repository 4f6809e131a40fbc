#pragma once
namespace weft { extern float g_tune[64]; inline float T(int i){return g_tune[i];} }
