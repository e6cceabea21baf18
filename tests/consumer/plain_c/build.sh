# SPDX-License-Identifier: GPL-3.0-or-later
regulus generate arm.toml crossing --name arm --isa portable -o kernel
flags="-O2 $(pkg-config --cflags regulus-runtime)"
c++ -std=c++20 $flags -c kernel/arm.cpp
c++ -std=c++20 $flags $(pkg-config --variable=portable_flags regulus-runtime) -c kernel/arm_portable.cpp
cc -std=c99 -Ikernel $flags guard.c arm.o arm_portable.o $(pkg-config --libs regulus-runtime) -o guard
