// Scratch driver for waves; becomes a case.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <complex>
#include "water_run.hpp"
using namespace pelagos; using namespace pelagos::validation;
static double opt(int argc,char**argv,const char*k,double d){for(int i=1;i+1<argc;++i)if(std::string(argv[i])==k)return atof(argv[i+1]);return d;}
static std::string sopt(int argc,char**argv,const char*k,std::string d){for(int i=1;i+1<argc;++i)if(std::string(argv[i])==k)return argv[i+1];return d;}
int main(int argc,char**argv){
  const double L=opt(argc,argv,"-L",60),D=opt(argc,argv,"-D",10),a=opt(argc,argv,"-a",1),W=opt(argc,argv,"-W",6),periods=opt(argc,argv,"-n",3);
  const double d=1; const bool walls=opt(argc,argv,"-walls",0)>0; const bool still=opt(argc,argv,"-still",0)>0; bool standing=opt(argc,argv,"-standing",0)>0;
  SolverChoice sc; sc.name=sopt(argc,argv,"-s","corrected"); sc.tolerance=opt(argc,argv,"-t",3e-4);
  FluidParameters p=tank_parameters({L,W,2*D+8},d,{standing?Edge::kMirror:Edge::kPeriodic,Edge::kPeriodic,walls?Edge::kWall:Edge::kMirror});
  p.viscosity*=opt(argc,argv,"-nu",1);
  Start st=fill_block(p,{L,W,walls?D+1:D});
  const double bottom=walls?0.5:0.0; // effective bottom
  const double k=(standing?1:2)*M_PI/L*opt(argc,argv,"-m",1), w=std::sqrt(9.81*k*std::tanh(k*D)), T=2*M_PI/w;
  const double amp=still?0:a;
  for(auto&q:st.positions){double X=q.x,Z=q.z-bottom-D; double C=std::cosh(k*(Z+D))/std::sinh(k*D),S=std::sinh(k*(Z+D))/std::sinh(k*D);
    if(standing){q.x=float(X-amp*C*std::sin(k*X));q.z=float(q.z+amp*S*std::cos(k*X));st.velocities.push_back({0,0,0,0});}
    else{q.x=float(X-amp*C*std::sin(k*X));q.z=float(q.z+amp*S*std::cos(k*X));
    st.velocities.push_back({float(amp*w*C*std::cos(k*X)),0,float(amp*w*S*std::sin(k*X)),0});}}
  WaterRun run(2,p,sc,st); run.state().parameters.filter=opt(argc,argv,"-f",3);
  run.state().parameters.density.min_iterations=int(opt(argc,argv,"-mi",2));
  run.state().parameters.density.tolerance=opt(argc,argv,"-rt",sc.tolerance);
  run.limit_steps(opt(argc,argv,"-dt",0.07),0.4);
  auto mode=[&](){std::complex<double> e=0,v=0;double vn=0,noise=0,on=0,ke=0; auto&P=run.state().particles; 
    for(size_t i=0;i<P.count;++i){double x=P.position[i].x;e+=std::polar(1.0,-k*x);}
    e*=2.0/(L*W)*(d*d*d)*(standing?1:1);
    // velocity mode fit
    std::complex<double> num=0; double den=0;
    for(size_t i=0;i<P.count;++i){double x=P.position[i].x,z=P.position[i].z-bottom-D;double C=std::cosh(k*(z+D))/std::sinh(k*D),S=std::sinh(k*(z+D))/std::sinh(k*D);
      // u = w C (A cos kx + B sin kx), wv = w S (A sin kx - B cos kx)
      double u=P.velocity[i].x,vz=P.velocity[i].z; num+=std::complex<double>(w*(C*std::cos(k*x)*u+S*std::sin(k*x)*vz), w*(C*std::sin(k*x)*u-S*std::cos(k*x)*vz)); den+=w*w*(C*C+S*S)/2;}
    num/=den; // each comp separately has den ~ sum of squares
    double A=num.real(),B=num.imag();
    for(size_t i=0;i<P.count;++i){double x=P.position[i].x,z=P.position[i].z-bottom-D;double C=std::cosh(k*(z+D))/std::sinh(k*D),S=std::sinh(k*(z+D))/std::sinh(k*D);
      double ux=w*C*(A*std::cos(k*x)+B*std::sin(k*x)),uz=w*S*(A*std::sin(k*x)-B*std::cos(k*x)); double dx=P.velocity[i].x-ux,dz=P.velocity[i].z-uz,dy=P.velocity[i].y;
      noise+=dx*dx+dy*dy+dz*dz;on+=ux*ux+uz*uz;ke+=P.velocity[i].x*P.velocity[i].x+dy*dy+P.velocity[i].z*P.velocity[i].z;}
    struct R{double eta,vel,noise,rms,phase;}; return R{std::abs(e),std::hypot(A,B),std::sqrt(noise/std::max(on,1e-30)),std::sqrt(ke/double(P.count)),std::arg(e)};};
  auto m0=mode(); double e0=m0.eta; 
  double en0=0; {auto r=run.measure(); en0=r.kinetic_energy+r.potential_energy;}
  for(int n=1;n<=periods*(standing?2:1);++n){ double peak=0; 
    if(standing){ run.advance_to((n-0.25)*T/2*1.0+ 0,[&]{}); while(run.time()<(n+0.25)*T/2){run.advance_to(run.time()+T/200);peak=std::max(peak,mode().eta);} }
    else run.advance_to(n*T); 
    auto m=mode(); auto c=run.cost(); auto r=run.measure(); double en=r.kinetic_energy+r.potential_energy;
    double eta=standing?peak:m.eta; double per=standing?n*0.5:n;
    std::printf("t/T %.1f eta %.4f loss/period %.2f%% vel %.4f noise/orb %.3f rms %.4f phase %+.3f dE %+.5f | it %.2f %.2f err %.1e max %.3f ms/step %.2f unc %ld\n",per,eta/e0,100*(1-std::pow(eta/e0,1/per)),m.vel,m.noise,m.rms,m.phase,(en-en0)/en0,c.density_iterations,c.velocity_iterations,c.density_error,c.largest_density,c.wall_s*1e3/c.steps,(long)c.unconverged_steps);
  }
}
