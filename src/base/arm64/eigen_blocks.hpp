// In the middle of Eigen/Core (arm_neon.h here): blocks of products are as where nothing is fused.
#undef EIGEN_HAS_SINGLE_INSTRUCTION_MADD
